// SPDX-License-Identifier: Apache-2.0
// Dialogs: a question with buttons, closed by Escape, the focus goes back to where it was.
import { button, h, newId } from './dom.js';

/**
 * Asks. `parts` are elements; `answers` {text, value}, the first one is that of the Enter key. Resolves with what value()
 * gives, or with null. `valid` may say by a sentence why the first answer is not taken.
 */
export function ask(title, parts, answers, valid = () => '') {
    return new Promise((resolve) => {
        const heading = newId('dialog');
        const focused = document.activeElement;
        const why = h('p', { class: 'wrong-note', role: 'alert' });
        const [first, ...others] = answers;
        const finish = (value) => { dialog.close(); dialog.remove(); focused?.focus?.(); resolve(value); };
        const submit = (event) => {
            event.preventDefault();
            why.textContent = valid();
            if (!why.textContent) finish(first.value());
        };
        const dialog = h('dialog', { 'aria-labelledby': heading, on: { cancel: (event) => { event.preventDefault(); finish(null); } } },
            h('form', { on: { submit }, noValidate: true }, h('h2', { id: heading }, title), parts, why,
                h('div', { class: 'bar answers' }, h('button', { type: 'submit', class: 'main' }, first.text),
                    others.map(({ text, value }) => button(text, () => finish(value()))),
                    button('Cancel', () => finish(null)))));
        document.body.append(dialog);
        dialog.showModal();
    });
}
