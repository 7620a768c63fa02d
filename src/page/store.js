// SPDX-License-Identifier: Apache-2.0
// The state of the page in one object that is never changed in place, and who is told of a new one.

/** A store: state(), change(parts) and subscribe(function of the new state). */
export function newStore(state) {
    const listeners = [];
    let present = Object.freeze(state);
    return {
        state: () => present,
        change(parts) {
            present = Object.freeze({ ...present, ...parts });
            for (const listener of listeners) listener(present);
        },
        subscribe: (listener) => listeners.push(listener),
    };
}
