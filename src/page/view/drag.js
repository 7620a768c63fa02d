// SPDX-License-Identifier: Apache-2.0
// Drag and drop with pointer events: mouse and pen anywhere on a row, touch on its handle, so that a finger still
// scrolls. Every drag has a way without one: arrow button, keyboard, menu.
import { h } from './dom.js';

const kThreshold = 5; // pixels before a press is a drag
const kEdge = 32;     // pixels from the edge of a list within which it scrolls

/** The place under the pointer: {list, row, behind}, or null. Lists have data-drop, rows the role option. */
function targetAt(x, y) {
    const under = document.elementFromPoint(x, y);
    const list = under?.closest('[data-drop]');
    if (!list) return null;
    const rows = [...list.querySelectorAll('[role=option]')];
    const row = rows.find((one) => y < one.getBoundingClientRect().bottom) ?? null;
    if (!row) return { list, row: null, behind: false };
    const box = row.getBoundingClientRect();
    return { list, row, behind: y > box.top + box.height / 2 };
}

function clearMarks() {
    for (const one of document.querySelectorAll('.drop-over, .drop-before, .drop-behind'))
        one.classList.remove('drop-over', 'drop-before', 'drop-behind');
}

function scrollEdges(target, y) {
    const box = target.list.querySelector('[role=listbox]');
    if (!box) return;
    const { top, bottom } = box.getBoundingClientRect();
    if (y < top + kEdge) box.scrollTop -= 12;
    if (y > bottom - kEdge) box.scrollTop += 12;
}

/** One drag from its first movement to its end. */
function newDrag(label, drop) {
    const ghost = h('div', { class: 'ghost', 'aria-hidden': 'true' }, label);
    document.body.append(ghost);
    document.documentElement.classList.add('dragging');
    let target = null;
    return {
        moveTo(x, y) {
            ghost.style.transform = `translate(${x + 12}px, ${y + 12}px)`;
            clearMarks();
            target = targetAt(x, y);
            if (!target) return;
            scrollEdges(target, y);
            target.list.classList.add('drop-over');
            target.row?.classList.add(target.behind ? 'drop-behind' : 'drop-before');
        },
        end(dropped) {
            ghost.remove();
            clearMarks();
            document.documentElement.classList.remove('dragging');
            if (dropped && target) drop(target);
        },
    };
}

/** Lets rows of a list be dragged. start(row) gives {label, drop(target)}. */
export function makeDraggable(element, start) {
    element.addEventListener('pointerdown', (event) => {
        const row = event.target.closest('[role=option]');
        const touch = event.pointerType === 'touch';
        if (!row || event.button !== 0 || (touch && !event.target.closest('.grip'))) return;
        const { clientX, clientY, pointerId } = event;
        const { label, drop } = start(row);
        let drag = null;
        const onMove = (move) => {
            if (move.pointerId !== pointerId) return;
            if (!drag && Math.hypot(move.clientX - clientX, move.clientY - clientY) < kThreshold) return;
            drag ??= newDrag(label, drop);
            drag.moveTo(move.clientX, move.clientY);
        };
        const finish = (dropped) => {
            removeEventListener('pointermove', onMove);
            removeEventListener('pointerup', onUp);
            removeEventListener('pointercancel', onCancel);
            removeEventListener('keydown', onKey, true);
            drag?.end(dropped);
        };
        const onUp = (up) => { if (up.pointerId === pointerId) { if (drag) drag.moveTo(up.clientX, up.clientY); finish(true); } };
        const onCancel = (cancel) => { if (cancel.pointerId === pointerId) finish(false); };
        const onKey = (key) => { if (drag && key.key === 'Escape') { key.stopPropagation(); finish(false); } };
        addEventListener('pointermove', onMove);
        addEventListener('pointerup', onUp);
        addEventListener('pointercancel', onCancel);
        addEventListener('keydown', onKey, true);
    });
    element.addEventListener('dragstart', (event) => event.preventDefault());
}
