// SPDX-License-Identifier: Apache-2.0
// How much of the limit the mapping uses. It stands above the lists, so that one sees it while one adds.
import { h, setText } from './dom.js';

function usedText({ parameters, max_parameters: mostParameters, words, max_words: mostWords }) {
    const full = parameters >= mostParameters || (mostWords !== null && words >= mostWords);
    const ofWords = mostWords === null ? `${words} words used` : `${words} of ${mostWords} words used`;
    return `${ofWords}, ${parameters} of ${mostParameters} parameters.${full ? ' The limit is reached: delete one before you add one.' : ''}`;
}

/** The view of what is used. */
export function meterView(app) {
    const meter = h('progress', { 'aria-label': 'Used of the limit' });
    const used = h('p', { class: 'used', 'data-used': '' });
    return {
        element: h('div', { class: 'limit' }, meter, used),
        update(state) {
            const count = app.ask.preview(state.history.present).used ?? null;
            setText(used, count ? usedText(count) : '');
            meter.hidden = !count;
            if (!count) return;
            const [most, now] = count.max_words === null ? [count.max_parameters, count.parameters] : [count.max_words, count.words];
            meter.max = most;
            meter.value = Math.min(most, now);
        },
    };
}
