// SPDX-License-Identifier: Apache-2.0
// The page put together: the state, the actions, the views, and the one place where the views learn of a new state.
import { drafting } from './actions/draft.js';
import { editing, explaining, standardDocument } from './actions/edit.js';
import { opening } from './actions/files.js';
import { keptNotes } from './actions/kept.js';
import { keeping } from './actions/library.js';
import { saving } from './actions/saving.js';
import { checking } from './actions/sides.js';
import { copyText } from './files/clipboard.js';
import { keep, keptText } from './files/storage.js';
import { newHistory } from './mapping/history.js';
import { contentOf } from './mapping/keeping.js';
import { isError, questions } from './questions.js';
import { newStore } from './store.js';
import { footView, headView, noticeView, otherDraftView } from './view/bars.js';
import { checkView } from './view/check.js';
import { detailsView } from './view/details.js';
import { h } from './view/dom.js';
import { watchFaults, watchInput } from './view/input.js';
import { listsView } from './view/lists.js';
import { liveView } from './view/live.js';
import { watchMenus } from './view/menu.js';
import { meterView } from './view/meter.js';
import { print, watchPrint } from './view/paper.js';
import { askDelete, askPrint, askReplace, askSave, chooseProfile } from './view/questions.js';
import { startView } from './view/start.js';
import { treeView } from './view/tree.js';

function firstState(ask) {
    return {
        screen: 'mapping', // start, mapping, check
        history: newHistory(standardDocument(ask)),
        selectedList: 'in', selectedAt: -1, // the list that is selected, and the place of the chosen parameter in the telegram
        inTelegramOrder: false, // one list with all parameters instead of one for each direction
        tab: null, query: '', treeTag: null, // the tree
        live: 'GSD file', // the tab of the live pane
        hints: keptText('hints') !== 'off',
        library: [], restored: false,
        kept: { draft: true, library: true }, // whether the browser has kept the newest one
        sides: [null, null], // the files that are checked
        saved: '', // the content of the mapping that was saved last
        otherDraft: null, // the draft of another window, as long as it is not decided which one stays
        reason: null, // why the last step was not done: {places, text}
        notice: null, said: { text: '', severity: '' },
    };
}

/** To a list that has parameters; to the search where none has, so that one is added. */
function leadToList(app) {
    const { history, selectedList } = app.store.state();
    const { list } = history.present;
    if (list.length === 0) return leadToField('search');
    const direction = list.some((one) => one.direction === selectedList) ? selectedList : list[0].direction;
    return app.showEntry(list.findIndex((one) => one.direction === direction));
}

function leadToField(key) {
    const found = document.querySelector(`.mapping :is([data-field="${key}"], [data-way="${key}"])`);
    found.scrollIntoView({ block: 'center' });
    found.focus({ preventScroll: true });
    found.select?.();
}

/** The actions that lie over several modules. */
function commands(app) {
    const { store, say, notify } = app;
    const picker = h('input', { type: 'file', class: 'unseen', tabIndex: -1, 'aria-label': 'File to open', 'data-open': '', on: {
        change: () => { if (picker.files[0]) app.files.open(picker.files[0]); picker.value = ''; } } });
    return {
        picker,
        go: (screen) => store.change({ screen, notice: null }),
        pickToOpen(accept = '.gsd,.gse,.gsg,.gsf,.gsi,.gsp,.gss,.toml,.csv,.json') {
            picker.accept = accept;
            picker.click();
        },
        setHints(hints) {
            keep('hints', hints ? 'on' : 'off');
            store.change({ hints });
            say(`Hints are ${hints ? 'on' : 'off'}.`);
        },
        isSaved: (state) => state.saved === contentOf(state.history.present),
        async copy(text, what) {
            say(await copyText(text) ? `${what} was copied.` : 'The browser does not let the page copy.', '');
        },
        async doSave() {
            if (!await app.save.save()) await app.doSaveAs();
        },
        async doSaveAs() {
            const document = store.state().history.present;
            const wanted = await askSave(document, app.ask.profile(document.profile), app.save.target()?.kind ?? 'gsd', {
                errorsOf: (ident) => app.ask.preview(ident === null ? document : { ...document, ident }).findings.filter(isError),
                lead: app.lead,
            });
            if (!wanted) return;
            if (wanted.ident !== null) app.edit.set('ident', wanted.ident);
            app.edit.seal();
            await app.save.saveAs(wanted.kind, wanted.name, wanted.place);
        },
        async doPrint() {
            const parts = await askPrint();
            if (parts) print(app, parts);
        },
        /** What was dragged to a list: {tag} from the tree, {from} from a list. */
        dropOn({ list, row, behind }, { tag, from }) {
            const before = row?.dataset.at === undefined ? null : Number(row.dataset.at) + (behind ? 1 : 0);
            const inTelegram = list.dataset.drop === 'telegram';
            const direction = inTelegram ? store.state().selectedList : list.dataset.drop;
            if (from !== undefined && inTelegram) app.edit.moveInTelegram(from, before ?? undefined);
            else if (from === undefined) app.edit.add(tag, direction, before);
            else app.edit.move(from, direction, before);
        },
        showEntry(at) {
            const { direction } = store.state().history.present.list[at];
            store.change({ selectedList: direction, selectedAt: at });
            app.focusList(direction);
        },
        /** Leads to what mends a finding: its parameter, or the field of the mapping, which gets the focus. */
        lead({ at, field: key }) {
            app.go('mapping');
            if (Number.isInteger(at)) app.showEntry(at);
            else if (key === 'list') leadToList(app);
            else leadToField(key);
        },
        async drop(files, side) {
            const onCheck = store.state().screen === 'check';
            if (!onCheck) await app.files.open(files[0]);
            else if (files.length === 1) await app.sides.check(files[0], side ?? (store.state().sides[0] ? 1 : 0));
            else for (const at of [0, 1]) await app.sides.check(files[at], at);
            const left = files.slice(onCheck ? 2 : 1).map((one) => one.name);
            if (left.length > 0)
                notify('warning', `${onCheck ? 'Two files are' : 'One file is'} taken at a time.`, [`Not read: ${left.join(', ')}.`]);
        },
    };
}

function mappingScreen(app) {
    const views = [treeView(app), meterView(app), listsView(app), detailsView(app), liveView(app)];
    const [tree, meter, lists, details, live] = views;
    app.focusList = lists.focusList;
    return {
        element: h('div', { class: 'mapping' }, details.first, tree.element, h('div', { class: 'middle' }, meter.element, lists.element, details.element), live.element),
        update(state) { for (const view of views) view.update(state); },
    };
}

function build(app) {
    const [head, notice, other, foot] = [headView(app), noticeView(app), otherDraftView(app), footView(app)];
    const screens = { start: startView(app), mapping: mappingScreen(app), check: checkView(app) };
    const main = h('main', { id: 'page', tabIndex: -1 }, Object.values(screens).map((one) => one.element));
    document.body.replaceChildren(h('div', { class: 'scroll' }, head.element, other.element, notice.element, main), foot.element);
    main.append(app.picker);
    app.store.subscribe((state) => {
        for (const view of [head, notice, other, foot]) view.update(state);
        for (const [name, screen] of Object.entries(screens)) {
            const left = name !== state.screen && screen.element.contains(document.activeElement);
            screen.element.hidden = name !== state.screen;
            if (left) main.focus({ preventScroll: true });
            if (name === state.screen) screen.update(state);
        }
    });
}

/** Starts the page on a core: call(request). */
export function startApp(call) {
    const ask = questions(call);
    const store = newStore(firstState(ask));
    const say = (text, severity = '') => store.change({ said: { text, severity } });
    const notify = (severity, title, sentences, findings = []) =>
        store.change({ notice: { severity, title, sentences, findings }, said: { text: title, severity } });
    const app = { ask, store, say, notify, explain: explaining({ store }) };
    app.noteKept = keptNotes(app);
    app.edit = editing(app);
    app.library = keeping({ ...app, askReplace, askDelete });
    app.draft = drafting({ ...app, collect: app.library.add });
    app.save = saving(app);
    app.files = opening({ ...app, chooseProfile: (name, why, names) => chooseProfile(name, why, names, ask.profile) });
    app.sides = checking(app);
    Object.assign(app, commands(app));
    build(app);
    watchMenus();
    watchInput(app);
    watchFaults(notify);
    watchPrint(app);
    restore(app);
    return app;
}

function restore(app) {
    const draft = app.draft.restored();
    let kept = null;
    app.store.subscribe(({ history }) => {
        if (history.present === kept) return;
        kept = history.present;
        app.draft.keep(kept);
    });
    app.library.watch();
    app.draft.watch();
    const { lists } = app.ask.profile(draft?.profile ?? '2408f');
    app.store.change({
        library: app.library.restored(), restored: draft !== null, selectedList: lists[0],
        ...(draft && { history: newHistory(draft) }),
    });
    const others = app.draft.collected();
    app.say([draft ? `The draft ${draft.name} was restored.` : 'The standard mapping EURO2400 is open.',
        others.length > 0 ? `The library has what other windows had kept: ${others.join(', ')}.` : ''].join(' ').trim());
}
