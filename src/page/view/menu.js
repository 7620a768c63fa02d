// SPDX-License-Identifier: Apache-2.0
// The context menu: opened by the right button, the menu key, or Shift+F10.
import { h } from './dom.js';

let open = null;

function close(back) {
    if (!open) return;
    const { menu, from } = open;
    open = null;
    menu.remove();
    if (back) from.focus();
}

function onKey(event) {
    const items = [...event.currentTarget.querySelectorAll('[role=menuitem]')];
    const at = items.indexOf(document.activeElement);
    const next = { ArrowDown: at + 1, ArrowUp: at - 1 + items.length, Home: 0, End: items.length - 1 }[event.key];
    if (next !== undefined) items[next % items.length].focus();
    else if (event.key === 'Escape') close(true);
    else if (event.key === 'Tab') close(true);
    else return;
    event.preventDefault();
    event.stopPropagation();
}

function place(menu, x, y) {
    const { width, height } = menu.getBoundingClientRect();
    menu.style.left = `${Math.max(4, Math.min(x, innerWidth - width - 4))}px`;
    menu.style.top = `${Math.max(4, Math.min(y, innerHeight - height - 4))}px`;
}

/** Opens a menu of {text, action} for an event on `from`, an element that gets the focus back. */
export function openMenu(event, from, label, items) {
    event.preventDefault();
    close(false);
    const menu = h('div', { role: 'menu', class: 'menu', 'aria-label': label, on: { keydown: onKey, contextmenu: (one) => one.preventDefault() } },
        items.map(({ text, action }) => h('button', {
            type: 'button', role: 'menuitem', tabIndex: -1,
            on: { click: () => { close(true); action(); } },
        }, text)));
    document.getElementById('page').append(menu);
    open = { menu, from };
    const box = (from.querySelector('[aria-selected=true]') ?? from).getBoundingClientRect();
    const byKey = !event.clientX && !event.clientY;
    place(menu, byKey ? box.left + 24 : event.clientX, byKey ? box.bottom : event.clientY);
    menu.firstElementChild.focus();
}

/** A press beside the menu closes it. */
export function watchMenus() {
    addEventListener('pointerdown', (event) => { if (open && !open.menu.contains(event.target)) close(false); }, true);
    addEventListener('blur', () => close(false));
}
