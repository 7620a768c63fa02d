// SPDX-License-Identifier: Apache-2.0
import { openCore } from './core.js';
import { startApp } from './app.js';

async function main() {
    try {
        const call = await openCore();
        globalThis.dpslaved = { call }; // for the tests: what the page asks, without the page
        startApp(call);
        document.documentElement.dataset.ready = 'yes';
    } catch (error) {
        document.getElementById('state').textContent = `The page cannot work in this browser: ${error.message}`;
    }
}

main();
