// SPDX-License-Identifier: Apache-2.0
// Shows documents of dpctl. Text goes in as text, never as HTML.

function element(name, text, attributes = {}) {
    const made = document.createElement(name);
    made.textContent = text;
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
}

function rows(table, lines) {
    table.tBodies[0].replaceChildren(...lines);
}

/// The whole lines of a stream as documents, and the beginning of the next line. null: a line is no document.
export function parse_lines(text) {
    const lines = text.split("\n");
    const rest = lines.pop();
    try {
        return { documents: lines.filter(Boolean).map(line => JSON.parse(line)), rest };
    } catch {
        return null;
    }
}

export function show_bus(place, bus, sentence) {
    if (bus === null) {
        place.textContent = sentence;
        return;
    }
    const faults = [bus.port_open ? "" : " The port is missing.", bus.driver_works ? "" : " The driver enable has failed."];
    place.textContent = `Bus on ${bus.port}, ${bus.baud / 1000} kbit/s (${bus.baud_state}). ` +
        `${bus.exchanging} of ${bus.stations} stations are in data exchange.${faults.join("")}`;
}

export function show_stations(table, stations) {
    const lamps = new Map([...table.tBodies[0].rows].map(row => [row.dataset.name, [...row.cells[5].childNodes]]));
    rows(table, stations.map(one => {
        const row = document.createElement("tr");
        row.dataset.name = one.name;
        row.append(
            element("th", one.name, { scope: "row" }), element("td", one.address),
            element("td", [one.state, one.held ? "held" : "", one.silent_because ?? ""].filter(Boolean).join(", ")),
            element("td", one.master ?? "none"), element("td", `${one.drive.link} (${one.drive.line}, ${one.drive.unit})`),
            element("td", ""));
        row.cells[5].append(...lamps.get(one.name) ?? []);
        return row;
    }));
}

/// Into the rows that show_stations() made.
export function show_lamps(table, stations) {
    const by_name = new Map(stations.map(one => [one.station.name, one.leds]));
    for (const row of table.tBodies[0].rows) {
        const leds = by_name.get(row.dataset.name);
        if (!leds) continue;
        row.cells[5].replaceChildren(
            ...leds.leds.map(led => element("span", `${led.name}: ${led.pattern}`, { class: led.lit ? "lamp lit" : "lamp" })),
            element("div", leds.meaning));
    }
}

export function show_values(table, words) {
    rows(table, words.map(word => {
        const row = document.createElement("tr");
        for (const text of [word.tag, word.name ?? "", word.direction, word.value, word.state]) row.append(element("td", text));
        return row;
    }));
}

export function show_diagnosis(place, diagnosis) {
    if (diagnosis === null) {
        place.replaceChildren();
        return;
    }
    const parts = [element("p", diagnosis.hex, { class: "hex" })];
    if (diagnosis.refusal !== null) {
        const { telegram, what, advice } = diagnosis.refusal;
        parts.push(element("p", `${telegram} was refused: ${what} ${advice}`, { class: "trouble" }));
    }
    for (const text of diagnosis.trouble) parts.push(element("p", text, { class: "trouble" }));
    const list = document.createElement("ul");
    for (const { octet, meaning } of diagnosis.octets) list.append(element("li", `Octet ${octet}: ${meaning}`));
    place.replaceChildren(...parts, list);
}

export function show_doctor(place, doctor) {
    if (!doctor?.findings) return;
    const parts = doctor.findings.map(finding => {
        const part = element("div", "", { class: "trouble" });
        const steps = document.createElement("ol");
        for (const step of finding.steps) steps.append(element("li", step));
        part.append(
            element("p", `${finding.station === null ? "" : finding.station + ": "}${finding.cause}`), element("p", finding.evidence),
            steps);
        return part;
    });
    if (parts.length === 0) parts.push(element("p", "All is well."));
    for (const note of doctor.notes) {
        const part = element("div", "");
        part.append(element("p", `${note.station === null ? "" : note.station + ": "}${note.cause}`), element("p", note.evidence));
        parts.push(part);
    }
    place.replaceChildren(...parts);
}

/// The form, where the station has the function block.
export function show_tec(form, select, tec) {
    form.hidden = tec === null;
    const names = (tec?.rows ?? []).filter(row => row.input).map(row => row.name);
    if ([...select.options].map(one => one.value).join("\n") === names.join("\n")) return;
    select.replaceChildren(...names.map(name => new Option(name, name)));
}

/// `exit`: 0 while the command runs and after it succeeded.
export function show_answer(place, text, exit = 0) {
    place.textContent = text.trim() || (exit === 0 ? "Done." : `dpctl ended with ${exit}.`);
    place.className = exit === 0 ? "" : "trouble";
}
