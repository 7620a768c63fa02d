// SPDX-License-Identifier: Apache-2.0
// Head and foot of the page: screens, tool bar, notices, what happened last, the hint of the area under the pointer.
import { button, h, setText } from './dom.js';
import { findingsList } from './findings.js';

const kScreens = { start: 'Start', mapping: 'Mapping', check: 'Check and compare' };

function toolBar(app) {
    const hints = button('Hints', () => app.setHints(!app.store.state().hints), { 'aria-pressed': 'true' });
    const tools = [
        button('New', () => app.go('start'), { title: 'New file: choose the device on the start screen' }),
        button('Open', () => app.pickToOpen(), { title: 'Open a file (Ctrl+O)' }),
        button('Save', () => app.doSave(), { title: 'Save (Ctrl+S)' }),
        button('Save as', () => app.doSaveAs(), { title: 'Save under another name or as another kind (Ctrl+Shift+S)' }),
        button('Undo', () => app.edit.undo(), { title: 'Undo (Ctrl+Z)' }),
        button('Redo', () => app.edit.redo(), { title: 'Redo (Ctrl+Y)' }),
        button('Print', () => app.doPrint(), { title: 'Print inputs, outputs, I/O map (Ctrl+P)' }),
        hints,
    ];
    const bar = h('div', { role: 'toolbar', 'aria-label': 'Tools', class: 'bar tools', 'data-hint': 'Undo has no end. Ctrl+O opens, Ctrl+S saves, Ctrl+Z and Ctrl+Y undo and redo, Ctrl+P prints.', on: { keydown } }, tools);
    const stop = (chosen) => { for (const tool of tools) tool.tabIndex = tool === chosen ? 0 : -1; };
    function keydown(event) {
        const at = tools.indexOf(document.activeElement);
        const next = { ArrowRight: at + 1, ArrowLeft: at - 1 + tools.length, Home: 0, End: tools.length - 1 }[event.key];
        if (at < 0 || next === undefined) return;
        event.preventDefault();
        stop(tools[next % tools.length]);
        tools[next % tools.length].focus();
    }
    stop(tools[0]);
    return {
        element: bar,
        update(state) {
            hints.setAttribute('aria-pressed', String(state.hints));
            const [undo, redo] = [tools[4], tools[5]];
            undo.setAttribute('aria-disabled', String(!state.history.past));
            redo.setAttribute('aria-disabled', String(!state.history.future));
        },
    };
}

/** The head of the page. */
export function headView(app) {
    const tools = toolBar(app);
    const screens = Object.entries(kScreens).map(([key, name]) => [key, button(name, () => app.go(key))]);
    const file = h('p', { class: 'file', 'data-file': '' });
    return {
        element: h('header', {}, h('h1', {}, 'GSD configurator'), file,
            h('nav', { 'aria-label': 'Screens', 'data-hint': 'Start: new file, samples, library. Mapping: edit. Check and compare: any GSD file.' }, screens.map(([, one]) => one)), tools.element),
        update(state) {
            const document = state.history.present;
            const unkept = Object.keys(state.kept).filter((one) => !state.kept[one]);
            setText(file, [document.name, document.profile, app.isSaved(state) ? '' : 'not saved',
                unkept.length > 0 ? `the browser does not keep the ${unkept.join(' and ')}` : ''].filter(Boolean).join(' · '));
            window.document.title = `${document.name} – GSD configurator of dpslaved`;
            for (const [key, one] of screens) {
                if (key === state.screen) one.setAttribute('aria-current', 'page');
                else one.removeAttribute('aria-current');
            }
            tools.update(state);
        },
    };
}

/** A notice with its sentences: it stays until it is closed or the next step is done. */
export function noticeView(app) {
    const text = h('div', {});
    const close = button('Close', () => app.store.change({ notice: null }), { more: 'the notice' });
    const box = h('div', { class: 'notice', hidden: true }, text, close);
    const element = h('div', { role: 'alert', class: 'notices' }, box); // in view wherever the page is scrolled to
    let shown = null;
    return {
        element,
        update({ notice }) {
            if (notice === shown) return;
            shown = notice;
            box.hidden = !notice;
            box.className = `notice ${notice?.severity ?? ''}`;
            text.replaceChildren();
            if (!notice) return;
            text.append(h('p', {}, h('span', { class: 'severity' }, notice.severity), ' ', h('strong', {}, notice.title)),
                notice.sentences.length > 0 ? h('ul', {}, notice.sentences.map((one) => h('li', {}, one))) : '',
                notice.findings.length > 0 ? findingsList(notice.findings, app.lead) : '');
        },
    };
}

/** Another window has changed the draft: it is taken, or this window keeps its own. */
export function otherDraftView(app) {
    const title = h('strong', {});
    const answer = (action) => () => {
        action();
        document.getElementById('page').focus({ preventScroll: true }); // the button that had the focus is gone
    };
    const box = h('div', { class: 'notice warning', hidden: true, 'data-other-draft': '' },
        h('div', {}, h('p', {}, title), h('p', {}, 'If you take it, undo brings back the mapping of this window. If you keep this one, ' +
            'the library has it when the page is opened again.')),
        h('div', { class: 'bar' }, button('Take the other draft', answer(() => app.draft.takeOther())),
            button('Keep this one', answer(() => app.draft.keepOwn()))));
    return {
        element: h('div', { role: 'alert' }, box),
        update({ otherDraft }) {
            box.hidden = !otherDraft;
            if (otherDraft) setText(title, otherDraft.title);
        },
    };
}

/** The foot: what happened, and the hint. */
export function footView(app) {
    const said = h('p', { id: 'said', role: 'status', 'aria-live': 'polite' });
    const hint = h('p', { class: 'hint', 'data-hint-bar': '' });
    let screen = '';
    const show = (event) => {
        const text = event.target.closest?.('[data-hint]')?.dataset.hint ?? '';
        if (text && app.store.state().hints) setText(hint, text);
    };
    document.addEventListener('pointerover', show);
    document.addEventListener('focusin', show);
    return {
        element: h('footer', {}, said, hint),
        update(state) {
            setText(said, state.said.text);
            said.className = state.said.severity;
            hint.hidden = !state.hints;
            if (screen === state.screen) return;
            screen = state.screen;
            setText(hint, 'Point at an area: its hint stands here. "Hints" in the tool bar switches it off.');
        },
    };
}
