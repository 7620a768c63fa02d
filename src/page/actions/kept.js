// SPDX-License-Identifier: Apache-2.0
// What the browser does not keep is said once, on whatever screen the user is, and stands in the head until it is kept.

/** noteKept(name, isKept): after each try to keep "draft" or "library". */
export function keptNotes({ store, notify }) {
    return (name, isKept) => {
        const { kept } = store.state();
        if (kept[name] === isKept) return;
        store.change({ kept: { ...kept, [name]: isKept } });
        if (!isKept)
            notify('error', `This browser does not keep the ${name}: it has no room, or the page may not keep anything.`,
                [`The ${name} is lost when the page is closed. Save your file, or export library and draft on the start screen.`]);
    };
}
