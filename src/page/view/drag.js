// SPDX-License-Identifier: Apache-2.0
// Drag and drop with pointer events: mouse and pen anywhere on a row, touch on its handle, so that a finger still
// scrolls. Every drag has a way without one: arrow button, keyboard, menu.
import { h } from './dom.js';

const kThreshold = 5; // pixels before a press is a drag
const kEdge = 32;     // pixels from the edge of a list or of the page within which it scrolls
const kStep = 8;      // pixels for each picture
const kWait_ms = 300; // so long the pointer is at the edge of the page before that scrolls: one that passes by moves nothing

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

/** Which way a box is to scroll: -1 up, 1 down, 0 not, because the pointer is not at an edge behind which there is more. */
function wayOf(box, y) {
    if (!box) return 0;
    const { top, bottom } = box.getBoundingClientRect();
    if (y < top + kEdge && box.scrollTop > 0) return -1;
    return y > bottom - kEdge && box.scrollTop + box.clientHeight < box.scrollHeight - 1 ? 1 : 0;
}

/** Scrolls list or page as long as the pointer is at an edge, also while it rests there. place() gives {target, y}. */
function newScrolling(place, scrolled) {
    const page = document.querySelector('.scroll');
    let since = null;
    let next = 0;
    function scroll(now) {
        const { target, y } = place();
        const list = target?.list.querySelector('[role=listbox]');
        const [ofList, ofPage] = [wayOf(list, y), wayOf(page, y)];
        since = ofPage === 0 ? null : since ?? now;
        if (ofList !== 0) list.scrollTop += ofList * kStep;
        else if (since !== null && now - since >= kWait_ms) page.scrollTop += ofPage * kStep;
        if (ofList !== 0 || since !== null) scrolled();
        next = requestAnimationFrame(scroll);
    }
    next = requestAnimationFrame(scroll);
    return { end: () => cancelAnimationFrame(next) };
}

/** One drag from its first movement to its end. */
function newDrag(label, drop) {
    const ghost = h('div', { class: 'ghost', 'aria-hidden': 'true' }, label);
    document.body.append(ghost);
    document.documentElement.classList.add('dragging');
    let target = null;
    let at = { x: 0, y: 0 };
    function aim() {
        clearMarks();
        target = targetAt(at.x, at.y);
        target?.list.classList.add('drop-over');
        target?.row?.classList.add(target.behind ? 'drop-behind' : 'drop-before');
    }
    const scrolling = newScrolling(() => ({ target, y: at.y }), aim);
    return {
        moveTo(x, y) {
            at = { x, y };
            ghost.style.transform = `translate(${x + 12}px, ${y + 12}px)`;
            aim();
        },
        end(dropped) {
            scrolling.end();
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
