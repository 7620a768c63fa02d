// SPDX-License-Identifier: Apache-2.0
// A list of tabs: one stop of the Tab key, arrows choose.
import { h, newId } from './dom.js';

/** Tabs of one panel. show(names, chosen) puts them up; choose(name) is called for the user's choice. */
export function tabs(label, panel, choose, { vertical = false } = {}) {
    const list = h('div', {
        role: 'tablist', 'aria-label': label, class: vertical ? 'tabs vertical' : 'tabs',
        'aria-orientation': vertical ? 'vertical' : 'horizontal', on: { keydown: onKey },
    });
    panel.id ||= newId('panel');
    panel.setAttribute('role', 'tabpanel');
    let names = [];

    function onKey(event) {
        const at = [...list.children].indexOf(event.target);
        const steps = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -at, End: names.length - 1 - at };
        if (at < 0 || steps[event.key] === undefined) return;
        event.preventDefault();
        const next = (at + steps[event.key] + names.length) % names.length;
        choose(names[next]);
        list.children[next].focus();
    }

    function show(wanted, chosen) {
        if (wanted.length !== names.length || wanted.some((name, at) => name !== names[at])) {
            names = wanted;
            list.replaceChildren(...names.map((name) => h('button', {
                type: 'button', role: 'tab', id: newId('tab'), 'aria-controls': panel.id, on: { click: () => choose(name) },
            }, name)));
        }
        [...list.children].forEach((tab, at) => {
            const selected = names[at] === chosen;
            tab.tabIndex = selected || (chosen === null && at === 0) ? 0 : -1;
            if (tab.getAttribute('aria-selected') === String(selected)) return;
            tab.setAttribute('aria-selected', String(selected));
            if (selected) panel.setAttribute('aria-labelledby', tab.id);
            if (selected && list.contains(document.activeElement)) tab.scrollIntoView({ block: 'nearest', inline: 'nearest' });
        });
    }
    return { list, show };
}
