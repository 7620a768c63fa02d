// SPDX-License-Identifier: Apache-2.0
// Files from and to the disk: read with a limit, write with the browser's picker where it has one, else as a download.
import { base64Of } from './octets.js';

const kMostOctets = 1024 * 1024; // as the core reads at most; it says so itself where a file has one more
const kMostLibrary = 16 * 1024 * 1024;

/** A file as the core takes it: {name, octets}. Of one that is too large only so much that the core sees that it is. */
export async function readFile(file) {
    const octets = new Uint8Array(await file.slice(0, kMostOctets + 3).arrayBuffer());
    return { name: file.name, octets: base64Of(octets) };
}

/** The text of a table in UTF-8. Null: it is larger than 1 MiB or no such text. */
export function readTable(file) {
    return textUpTo(file, kMostOctets);
}

/** The text of an exported library. Null: it is larger than 16 MiB or no text in UTF-8. */
export function readLibrary(file) {
    return textUpTo(file, kMostLibrary);
}

async function textUpTo(file, most) {
    if (file.size > most) return null;
    try {
        return new TextDecoder('utf-8', { fatal: true }).decode(await file.arrayBuffer());
    } catch {
        return null;
    }
}

/** Whether the browser lets a page write a file that the user has picked. */
export function hasPicker() {
    return typeof globalThis.showSaveFilePicker === 'function';
}

/** Lets the user pick a file to write. Null: the user has picked none. */
export async function pickFile(name, ending, what) {
    try {
        return await globalThis.showSaveFilePicker({
            suggestedName: name,
            types: [{ description: what, accept: { 'application/octet-stream': [ending] } }],
        });
    } catch (error) {
        if (error.name === 'AbortError') return null;
        throw error;
    }
}

/** Writes octets into a file that was picked. */
export async function writePicked(handle, octets) {
    const stream = await handle.createWritable();
    await stream.write(octets);
    await stream.close();
}

/** Gives octets to the browser's downloads. */
export function download(name, octets) {
    const address = URL.createObjectURL(new Blob([octets], { type: 'application/octet-stream' }));
    const link = document.createElement('a');
    link.href = address;
    link.download = name;
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
}
