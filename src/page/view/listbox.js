// SPDX-License-Identifier: Apache-2.0
// A list of rows of which one is chosen: one stop of the Tab key, arrows choose, other keys are the list's own.
import { h } from './dom.js';

const kPiece = 60; // rows that are put up at once: the layout of a thousand would delay each key of the search

/**
 * A list box of items. rowOf(item) gives an item's row, the same one each time: an element with the role option and an id.
 * choose(item) is called for the user's choice, key(event, item) for the keys that are not the list's own.
 * With `keepPlace` other items do not scroll the list to its start.
 */
export function listbox(properties, { rowOf, choose, key, keepPlace = false }) {
    const element = h('div', {
        role: 'listbox', tabIndex: 0, ...properties,
        on: { keydown: onKey, pointerdown: onPointer, focus: onFocus, scroll: onScroll, ...properties.on },
    });
    let items = [];
    let chosen = null;
    let row = null; // of the chosen item
    let shown = 0;  // of the items; further ones follow when the user comes to their end

    const itemOf = (target) => {
        const at = [...element.children].indexOf(target.closest?.('[role=option]'));
        return at < 0 ? null : items[at];
    };

    function grow(least) {
        const end = Math.min(items.length, Math.max(least, shown + kPiece));
        element.append(...items.slice(shown, end).map((item, at) => {
            const next = rowOf(item);
            next.setAttribute('aria-posinset', shown + at + 1);
            next.setAttribute('aria-setsize', items.length);
            return next;
        }));
        shown = end;
    }

    function onScroll() {
        if (shown < items.length && element.scrollTop + 2 * element.clientHeight > element.scrollHeight) grow(0);
    }
    function onPointer(event) {
        const item = itemOf(event.target);
        if (item && event.button === 0) choose(item);
    }
    function onFocus() {
        if (!chosen && items.length > 0) choose(items[0]);
    }
    function onKey(event) {
        const at = items.indexOf(chosen);
        const next = {
            ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1, PageDown: at + 10, PageUp: at - 10,
        }[event.key];
        if (next === undefined || event.altKey || event.ctrlKey || event.metaKey) key(event, chosen);
        else {
            event.preventDefault();
            if (items.length > 0) choose(items[Math.max(0, Math.min(next, items.length - 1))]);
        }
        row?.scrollIntoView({ block: 'nearest' });
    }
    /** Scrolls the list alone: were the page scrolled as well, a button would move away under the pointer that presses it. */
    function scrollToRow() {
        const [inner, outer] = [row.getBoundingClientRect(), element.getBoundingClientRect()];
        if (inner.top < outer.top) element.scrollTop -= outer.top - inner.top;
        else if (inner.bottom > outer.bottom) element.scrollTop += inner.bottom - outer.bottom;
    }

    function mark(item) {
        row?.setAttribute('aria-selected', 'false');
        chosen = item;
        row = item && rowOf(item);
        if (!row) return element.removeAttribute('aria-activedescendant');
        const at = items.indexOf(item);
        if (at >= shown) grow(at + 1);
        row.setAttribute('aria-selected', 'true');
        element.setAttribute('aria-activedescendant', row.id);
        return scrollToRow();
    }

    return {
        element,
        itemOf,
        /** Puts items up, if they are others, and marks the chosen one, or none. */
        show(next, wanted) {
            if (next !== items) {
                const [top, least] = keepPlace ? [element.scrollTop, shown] : [0, 0];
                items = next;
                shown = 0;
                element.replaceChildren();
                grow(least);
                element.scrollTop = top;
            }
            if (wanted !== chosen) mark(wanted);
        },
    };
}
