// SPDX-License-Identifier: Apache-2.0
// The browser's storage. It may be missing, full or forbidden: then keep() says so and nothing else happens.

const kPrefix = 'dpslaved.configurator.';

const seen = new Map(); // by name: the text that this window has read, written or been told of last

/** The text kept under a name. Null: none, or there is no storage. */
export function keptText(name) {
    try {
        const text = localStorage.getItem(kPrefix + name);
        seen.set(name, text);
        return text;
    } catch {
        return null;
    }
}

/** Keeps a text. False: it could not be kept. */
export function keep(name, text) {
    try {
        localStorage.setItem(kPrefix + name, text);
        seen.set(name, text);
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

/** Keeps a text under another name from now on. False: there is none, or no room for it. It is gone from its place in any case. */
export function setAside(name, other) {
    const text = keptText(name);
    forget(name); // first: both may have no room beside each other
    return text !== null && keep(other, text);
}

/**
 * Calls a function when another window of the page keeps a text under this name. The window also looks itself when it gets
 * the focus: WebKitGTK 2.50 tells nothing to a page that was loaded again.
 */
export function onKeptElsewhere(name, listener) {
    const meet = (text) => {
        seen.set(name, text);
        listener(text);
    };
    addEventListener('storage', (event) => {
        if (event.key === kPrefix + name && event.newValue !== null) meet(event.newValue);
    });
    addEventListener('focus', () => {
        const before = seen.get(name);
        const text = keptText(name);
        if (text !== null && text !== before) meet(text);
    });
}
