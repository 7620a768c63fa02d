// SPDX-License-Identifier: Apache-2.0
// Dialogs: a question with buttons, closed by Escape, the focus goes back to where it was.
import { button, h, newId } from './dom.js';

/** Puts the reason where the eye is: under the field that it is about, which gets the focus. Without a field it stands above the buttons. */
function showReason(dialog, why, reason) {
    for (const one of dialog.querySelectorAll('[aria-invalid=true]')) one.setAttribute('aria-invalid', 'false');
    why.textContent = reason?.text ?? '';
    if (!reason?.input) return dialog.querySelector('.answers').before(why);
    reason.input.setAttribute('aria-invalid', 'true');
    reason.input.closest('.field')?.append(why);
    return reason.input.focus();
}

/**
 * Asks. `parts` are elements, or a function that gets a function which ends the dialog without an answer; `answers` {text,
 * value}, the first one is that of the Enter key. Resolves with what value() gives, or with null. valid() may say why the
 * first answer is not taken: {text, input}, `input` the field that it is about, or null where it is about none.
 */
export function ask(title, parts, answers, valid = () => null) {
    return new Promise((resolve) => {
        const heading = newId('dialog');
        const focused = document.activeElement;
        const why = h('p', { class: 'wrong-note', role: 'alert' });
        const [first, ...others] = answers;
        const finish = (value) => { dialog.close(); dialog.remove(); focused?.focus?.(); resolve(value); };
        const submit = (event) => {
            event.preventDefault();
            const reason = valid();
            showReason(dialog, why, reason);
            if (!reason) finish(first.value());
        };
        const dialog = h('dialog', { 'aria-labelledby': heading, on: { cancel: (event) => { event.preventDefault(); finish(null); } } },
            h('form', { on: { submit }, noValidate: true }, h('h2', { id: heading }, title), typeof parts === 'function' ? parts(() => finish(null)) : parts, why,
                h('div', { class: 'bar answers' }, h('button', { type: 'submit', class: 'main' }, first.text),
                    others.map(({ text, value }) => button(text, () => finish(value()))),
                    button('Cancel', () => finish(null)))));
        document.body.append(dialog);
        dialog.showModal();
    });
}
