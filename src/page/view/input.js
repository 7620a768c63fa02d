// SPDX-License-Identifier: Apache-2.0
// Keys and files for the page as a whole.

function onKey(app, event) {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || document.querySelector('dialog[open]')) return;
    const action = {
        s: () => (event.shiftKey ? app.doSaveAs() : app.doSave()),
        o: () => app.pickToOpen(),
        p: () => app.doPrint(),
        z: () => (event.shiftKey ? app.edit.redo() : app.edit.undo()),
        y: () => app.edit.redo(),
    }[event.key.toLowerCase()];
    const ownUndo = event.target.closest?.('input:not([data-field]):not([type=checkbox]), textarea');
    if (!action || (ownUndo && 'zy'.includes(event.key.toLowerCase()))) return;
    event.preventDefault();
    action();
}

const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes('Files');

/** A fault of the page itself is said, not hidden: the draft is still there. */
export function watchFaults(notify) {
    let told = false;
    const tell = (reason) => {
        if (told) return;
        told = true;
        notify('error', 'The page has met a fault of its own.',
            [String(reason?.message ?? reason), 'Export library and draft on the start screen, then open the page again.']);
    };
    addEventListener('error', (event) => tell(event.error ?? event.message));
    addEventListener('unhandledrejection', (event) => tell(event.reason));
}

/** Listens to shortcuts and to files that are dropped on the page. */
export function watchInput(app) {
    addEventListener('keydown', (event) => onKey(app, event));
    addEventListener('dragover', (event) => {
        event.preventDefault(); // else the browser would leave the page for the file
        if (event.dataTransfer) event.dataTransfer.dropEffect = hasFiles(event) ? 'copy' : 'none';
    });
    addEventListener('drop', (event) => {
        event.preventDefault();
        const files = [...(event.dataTransfer?.files ?? [])];
        const side = event.target.closest?.('[data-drop-file]')?.dataset.dropFile;
        if (files.length > 0) app.drop(files, side === undefined ? undefined : Number(side));
    });
    addEventListener('beforeunload', (event) => {
        const state = app.store.state();
        if (state.kept.library && (state.kept.draft || !state.history.past || app.isSaved(state))) return;
        event.preventDefault();
        event.returnValue = true; // Chrome before 119 looks at this alone
    });
}
