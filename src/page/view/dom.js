// SPDX-License-Identifier: Apache-2.0
// Elements without markup: a text is always a text, whatever stands in it.

/** An element. Properties: `class`, `on` (listeners by event), `data-...` and `aria-...` as attributes, others as properties. */
export function h(name, properties = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (value === null || value === undefined) continue;
        if (key === 'class') element.className = value;
        else if (key === 'on') for (const [event, listener] of Object.entries(value)) element.addEventListener(event, listener);
        else if (/^(aria-|data-|role$|for$|scope$)/.test(key)) element.setAttribute(key, value);
        else element[key] = value;
    }
    element.append(...children.flat(9).filter((child) => child !== null && child !== undefined));
    return element;
}

let ids = 0;
/** An id of its own for an element that another one names. */
export function newId(stem) {
    return `${stem}-${++ids}`;
}

/**
 * A button with a visible text. `more` completes the name for those who do not see where it stands. A `compact` one shows its
 * icon alone.
 */
export function button(text, action, { more = '', icon = '', compact = false, ...properties } = {}) {
    return h('button', { type: 'button', on: { click: action }, ...(compact && { title: text }), ...properties },
        icon ? h('span', { class: 'icon', 'aria-hidden': 'true' }, icon) : null,
        h('span', { class: compact ? 'unseen' : '' }, text), more ? h('span', { class: 'unseen' }, ` ${more}`) : null);
}

/** A field with its label. Gives {row, input}. */
export function field(label, input, note = '') {
    const id = newId('field');
    input.id = id;
    const described = note ? h('span', { class: 'note', id: `${id}-note` }, note) : null;
    if (described) input.setAttribute('aria-describedby', described.id);
    return { row: h('div', { class: 'field' }, h('label', { for: id }, label), input, described), input };
}

/** A check box with its label. */
export function checkbox(label, checked, action) {
    const input = h('input', { type: 'checkbox', checked, on: { change: () => action(input.checked) } });
    return { row: h('label', { class: 'check' }, input, h('span', {}, label)), input };
}

/** An area of the screen with a heading and the hint that belongs to it. */
export function area(name, hint, properties, ...children) {
    return h('section', { ...properties, 'aria-label': name, 'data-hint': hint }, h('h2', {}, name), ...children);
}

/** Sets a text only where it differs: a live region then says it only when it is new. */
export function setText(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/** Why the last step was not done, where it was asked for. Empty: it was done, or it was asked for elsewhere. */
export function reasonAt({ reason }, place) {
    return reason?.places.includes(place) ? reason.text : '';
}

/** The class of a parameter's colour, "D" for Demand Data. The number beside it says the same without colour. */
export function hueOf(number) {
    return `hue hue-${number === 'D' ? 'd' : number % 8}`;
}
