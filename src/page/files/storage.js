// SPDX-License-Identifier: Apache-2.0
// The browser's storage. It may be missing, full or forbidden: then keep() says so and nothing else happens.

const kPrefix = 'dpslaved.configurator.';

/** The text kept under a name. Null: none, or there is no storage. */
export function keptText(name) {
    try {
        return localStorage.getItem(kPrefix + name);
    } catch {
        return null;
    }
}

/** Keeps a text. False: it could not be kept. */
export function keep(name, text) {
    try {
        localStorage.setItem(kPrefix + name, text);
        return true;
    } catch {
        return false;
    }
}

/** The names, under which a text is kept, that start so. */
export function keptNames(start) {
    try {
        return Object.keys(localStorage).filter((key) => key.startsWith(kPrefix + start)).map((key) => key.slice(kPrefix.length));
    } catch {
        return [];
    }
}

/** Keeps the text under a name no longer. */
export function forget(name) {
    try {
        localStorage.removeItem(kPrefix + name);
    } catch {
        // without storage nothing was kept
    }
}

/** Calls a function when another window of the page keeps a text under this name. */
export function onKeptElsewhere(name, listener) {
    addEventListener('storage', (event) => {
        if (event.key === kPrefix + name && event.newValue !== null) listener(event.newValue);
    });
}
