// SPDX-License-Identifier: Apache-2.0
// A list of rows of which one is chosen: one stop of the Tab key, arrows choose, other keys are the list's own.
import { h } from './dom.js';

const kPiece = 60; // rows that are put up at once: the layout of a thousand would delay each key of the search

/** The rows of items in an element: the first ones at once, further ones when the user comes to their end. */
function pieces(element, rowOf) {
    let items = [];
    let shown = 0;

    function grow(least = 0) {
        const end = Math.min(items.length, Math.max(least, shown + kPiece));
        element.append(...items.slice(shown, end).map((item, at) => {
            const next = rowOf(item);
            next.setAttribute('aria-posinset', shown + at + 1);
            next.setAttribute('aria-setsize', items.length);
            return next;
        }));
        shown = end;
    }

    element.addEventListener('scroll', () => {
        if (shown < items.length && element.scrollTop + 2 * element.clientHeight > element.scrollHeight) grow();
    });
    return {
        items: () => items,
        itemOf(target) {
            const at = [...element.children].indexOf(target.closest?.('[role=option]'));
            return at < 0 ? null : items[at];
        },
        /** Puts further items up. With `keepPlace` the list stays where it is scrolled to. */
        replace(next, keepPlace) {
            const [top, least] = keepPlace ? [element.scrollTop, shown] : [0, 0];
            items = next;
            shown = 0;
            element.replaceChildren();
            grow(least);
            element.scrollTop = top;
        },
        /** The row of an item: it is put up. */
        reach(item) {
            const at = items.indexOf(item);
            if (at >= shown) grow(at + 1);
            return rowOf(item);
        },
    };
}

/** Scrolls the list alone: were the page scrolled as well, a button would move away under the pointer that presses it. */
function scrollTo(row, element) {
    const [inner, outer] = [row.getBoundingClientRect(), element.getBoundingClientRect()];
    if (inner.top < outer.top) element.scrollTop -= outer.top - inner.top;
    else if (inner.bottom > outer.bottom) element.scrollTop += inner.bottom - outer.bottom;
}

/** The place to which a key leads from another one. Undefined: the key is none of the list. */
function placeAfter({ key, altKey, ctrlKey, metaKey }, at, last) {
    if (altKey || ctrlKey || metaKey) return undefined;
    const next = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: last, PageDown: at + 10, PageUp: at - 10 }[key];
    return next === undefined ? undefined : Math.max(0, Math.min(next, last));
}

/**
 * A list box of items. rowOf(item) gives an item's row, the same one each time: an element with the role option and an id.
 * choose(item) is called for the user's choice, key(event, item) for the keys that are not the list's own.
 * With `keepPlace` other items do not scroll the list to its start.
 */
export function listbox(properties, { rowOf, choose, key, keepPlace = false }) {
    const element = h('div', {
        role: 'listbox', tabIndex: 0, ...properties,
        on: { keydown: onKey, pointerdown: onPointer, focus: onFocus, ...properties.on },
    });
    const rows = pieces(element, rowOf);
    let chosen = null;
    let row = null; // of the chosen item

    function onPointer(event) {
        const item = rows.itemOf(event.target);
        if (item && event.button === 0) choose(item);
    }
    function onFocus() {
        if (!chosen && rows.items().length > 0) choose(rows.items()[0]);
    }
    function onKey(event) {
        const items = rows.items();
        const next = placeAfter(event, items.indexOf(chosen), items.length - 1);
        if (next === undefined) key(event, chosen);
        else {
            event.preventDefault();
            if (items.length > 0) choose(items[next]);
        }
        row?.scrollIntoView({ block: 'nearest' });
    }
    function mark(item) {
        row?.setAttribute('aria-selected', 'false');
        chosen = item;
        row = item && rows.reach(item);
        if (!row) return element.removeAttribute('aria-activedescendant');
        row.setAttribute('aria-selected', 'true');
        element.setAttribute('aria-activedescendant', row.id);
        return scrollTo(row, element);
    }

    return {
        element,
        itemOf: rows.itemOf,
        /** Puts items up, if they are others, and marks the chosen one, or none. */
        show(next, wanted) {
            if (next !== rows.items()) rows.replace(next, keepPlace);
            if (wanted !== chosen) mark(wanted);
        },
    };
}
