// SPDX-License-Identifier: Apache-2.0
import { openCore } from './core.js';
import { startApp } from './app.js';
import { setAside } from './files/storage.js';
import { h } from './view/dom.js';

/** In place of the page: what went wrong, and what to do. */
function showFault(sentences) {
    document.body.replaceChildren(h('main', { id: 'page' }, sentences.map((one) => h('p', { role: 'alert' }, one))));
}

async function main() {
    let call = null;
    try {
        call = await openCore();
    } catch (error) {
        return showFault([`The page cannot work in this browser: ${error.message}`]);
    }
    try {
        globalThis.dpslaved = { call }; // for the tests: what the page asks, without the page
        startApp(call);
        document.documentElement.dataset.ready = 'yes';
    } catch (error) {
        // A draft that the page cannot show would stop it at each start.
        const had = setAside('draft', 'draft set aside');
        showFault([`The page has met a fault of its own: ${error.message}`,
            had ? 'The draft of the last time was set aside. Open the page again: it begins with the standard mapping.' : '']);
    }
    return undefined;
}

main();
