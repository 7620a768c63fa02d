// SPDX-License-Identifier: Apache-2.0
// Undo and redo without end. Pure: past and future are linked lists, so a step costs the same however many there are.

/** A history that has one value and no steps. */
export function newHistory(value) {
    return { present: value, past: null, future: null, key: '' };
}

/**
 * A step to a further value; what was undone is forgotten. Steps with the same key that follow each other are one, as the
 * letters typed into a field are.
 */
export function push(history, value, key = '') {
    if (value === history.present) return history;
    const merged = key !== '' && key === history.key;
    const past = merged ? history.past : { value: history.present, rest: history.past };
    return { present: value, past, future: null, key };
}

/** The next step is one of its own, also with the same key. */
export function seal(history) {
    return history.key === '' ? history : { ...history, key: '' };
}

/** One step back. The same history where there is none. */
export function undo(history) {
    if (!history.past) return history;
    const future = { value: history.present, rest: history.future };
    return { present: history.past.value, past: history.past.rest, future, key: '' };
}

/** One step forward again. The same history where there is none. */
export function redo(history) {
    if (!history.future) return history;
    const past = { value: history.present, rest: history.past };
    return { present: history.future.value, past, future: history.future.rest, key: '' };
}
