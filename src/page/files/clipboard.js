// SPDX-License-Identifier: Apache-2.0
// Text to the clipboard, also where the page's address is not allowed the newer interface.

function copyBySelection(text) {
    const field = document.createElement('textarea');
    field.value = text;
    field.className = 'unseen';
    const focused = document.activeElement;
    document.body.append(field);
    field.select();
    const done = document.execCommand('copy');
    field.remove();
    focused?.focus();
    return done;
}

/** Copies a text. False: the browser does not let the page do it. */
export async function copyText(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return copyBySelection(text);
    }
}
