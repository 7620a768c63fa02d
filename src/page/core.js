// SPDX-License-Identifier: Apache-2.0
// The libraries of dpslaved as WebAssembly: instantiated once, then each question is one call. Requests and replies:
// docs/internals/configurator-calls.md.

/** The octets of a block of the page: base64 of a raw deflate stream. */
async function octetsOf(id) {
    const packed = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** What wasi-libc asks of a system. There is none: no argument, no variable, no file, no output. */
function system(memory) {
    const kSuccess = 0, kBadDescriptor = 8;
    const none = (first, second) => {
        const view = new DataView(memory().buffer);
        view.setUint32(first, 0, true);
        view.setUint32(second, 0, true);
        return kSuccess;
    };
    const refuse = () => kBadDescriptor;
    const known = {
        args_sizes_get: none, args_get: () => kSuccess, environ_sizes_get: none, environ_get: () => kSuccess,
        proc_exit: (code) => { throw new Error(`the program ended with ${code}`); },
    };
    return new Proxy({}, { get: (_, name) => known[name] ?? refuse });
}

/** Loads the libraries and the project's files. Returns call(request): a request as an object, its reply as an object. */
export async function openCore() {
    const module = await WebAssembly.compile(await octetsOf('core'));
    let instance = null;
    const stubs = system(() => instance.exports.memory);
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = stubs[name];
    instance = await WebAssembly.instantiate(module, imports);
    const core = instance.exports;
    core._initialize();

    const put = (octets) => {
        const at = core.room(octets.length); // it may grow the memory, which then has another buffer
        new Uint8Array(core.memory.buffer, at, octets.length).set(octets);
    };
    const encoder = new TextEncoder();
    const decoder = new TextDecoder();
    const files = JSON.parse(decoder.decode(await octetsOf('files')));
    for (const [name, text] of Object.entries(files)) {
        const start = encoder.encode(name);
        const rest = encoder.encode(text);
        const both = new Uint8Array(start.length + rest.length);
        both.set(start);
        both.set(rest, start.length);
        put(both);
        core.add_file(start.length);
    }
    // Half a character, as a file name of Windows may have, is no text in UTF-8: it becomes a replacement character.
    const whole = (_, value) => (typeof value === 'string' ? decoder.decode(encoder.encode(value)) : value);
    return (request) => {
        put(encoder.encode(JSON.stringify(request, whole)));
        const at = core.call();
        return JSON.parse(decoder.decode(new Uint8Array(core.memory.buffer, at, core.reply_size())));
    };
}
