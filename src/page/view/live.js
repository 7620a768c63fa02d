// SPDX-License-Identifier: Apache-2.0
// What the mapping gives, while it is edited: findings, the text of the file, octets, I/O map.
import { fileNameOf } from '../mapping/model.js';
import { area, button, h, setText } from './dom.js';
import { findingsList, summaryOf } from './findings.js';
import { mapPart, mapText, octetsPart, octetsText } from './octets.js';
import { tabs } from './tabs.js';
import { textPart } from './text.js';

const kTabs = ['GSD file', 'Octets', 'I/O map'];

/** What the shown tab has, as text. */
function textOfTab(tab, preview) {
    return { 'GSD file': preview.text ?? '', Octets: octetsText(preview), 'I/O map': mapText(preview) }[tab];
}

function partOfTab(tab, preview) {
    if (tab === 'Octets') return octetsPart(preview);
    if (tab === 'I/O map') return mapPart(preview);
    return preview.text ? h('pre', { tabIndex: 0, role: 'region', 'aria-label': 'Text of the GSD file' }, textPart(preview))
        : h('p', {}, 'The mapping does not fit into a telegram, or it is refused: see the findings.');
}

/** The view of the live pane. */
export function liveView(app) {
    const { store, ask } = app;
    const summary = h('p', { class: 'count', 'data-findings': '' });
    const findings = h('div', {});
    const panel = h('div', { class: 'live-panel', tabIndex: 0 });
    const strip = tabs('Preview', panel, (live) => store.change({ live }));
    const copy = button('Copy', () => {
        const { live, history } = store.state();
        app.copy(textOfTab(live, ask.preview(history.present)), live);
    }, { more: 'what is shown' });
    const element = area('Preview', 'What the file says and what the master sends, as it is now. Each parameter has the same ' +
        'number and colour everywhere.', { class: 'live' },
    h('section', { class: 'finding-area', tabIndex: 0, 'aria-label': 'Findings' }, summary, findings),
    h('div', { class: 'bar spread' }, strip.list, copy), panel);

    let shown = {};
    return {
        element,
        update(state) {
            const preview = ask.preview(state.history.present);
            strip.show(kTabs, state.live);
            if (shown.preview === preview && shown.live === state.live) return;
            if (shown.preview !== preview) {
                setText(summary, `${fileNameOf(state.history.present)}: ${summaryOf(preview.findings)}`);
                findings.replaceChildren(findingsList(preview.findings, app.lead));
            }
            shown = { preview, live: state.live };
            panel.replaceChildren(partOfTab(state.live, preview));
        },
    };
}
