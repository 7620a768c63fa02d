// SPDX-License-Identifier: Apache-2.0
// What the mapping gives, while it is edited: findings, the text of the file, octets, I/O map.
import { area, button, h, setText } from './dom.js';
import { mapPart, mapText, octetsPart, octetsText } from './octets.js';
import { tabs } from './tabs.js';
import { textPart } from './text.js';

const kTabs = ['GSD file', 'Octets', 'I/O map'];

/** A list of findings. `at` of a finding leads to its parameter where `lead` is given. */
export function findingsList(findings, lead = null) {
    return h('ul', { class: 'findings' }, findings.map((one) => h('li', { class: one.severity, 'data-code': one.code ?? '' },
        h('span', { class: 'severity' }, one.severity), ' ',
        one.line > 0 ? h('span', { class: 'line' }, `line ${one.line}: `) : null, h('span', {}, one.text),
        lead && Number.isInteger(one.at) ? [' ', button('Show', () => lead(one.at), { more: 'the parameter' })] : null)));
}

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

function summaryOf(findings) {
    const count = (severity) => findings.filter((one) => one.severity === severity).length;
    const some = (number, word) => `${number} ${word}${number === 1 ? '' : 's'}`;
    if (findings.length === 0) return 'No findings.';
    return `${some(count('error'), 'error')}, ${some(count('warning'), 'warning')}`;
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
                setText(summary, summaryOf(preview.findings));
                findings.replaceChildren(findingsList(preview.findings, (at) => app.showEntry(at)));
            }
            shown = { preview, live: state.live };
            panel.replaceChildren(partOfTab(state.live, preview));
        },
    };
}
