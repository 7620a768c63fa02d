// SPDX-License-Identifier: Apache-2.0
// What dpctl says of the running daemon, live, and the operator's commands. It runs dpctl as the user who is logged in:
// the daemon judges the rights, and what it refuses is shown as dpctl words it.
import { parse_lines, show_answer, show_bus, show_diagnosis, show_doctor, show_lamps, show_stations, show_tec, show_values }
    from "./view.js";

const cockpit = window.cockpit;
const POLL_MS = 3000; // what is not in the live picture: lamps, diagnosis, doctor
const RETRY_MS = 3000;
const id = name => document.getElementById(name);

let picture = null; // the newest document that a follower printed
let chosen = null; // the name of a station

const failure_text = failure => (failure.problem === "not-found" ? "dpctl is not installed." : failure.message ?? String(failure));

/// The document that a command prints with --json, whatever its exit status is; null: none.
function ask(words) {
    const document_of = text => {
        try {
            return JSON.parse(text);
        } catch {
            return null;
        }
    };
    return new Promise(resolve => {
        cockpit.spawn(["dpctl", "--json", ...words], { err: "message" })
            .then(out => resolve(document_of(out)))
            .catch((failure, out) => resolve(document_of(out)));
    });
}

// ---- live

// Both print the same documents: one at each change of a state, the other at each change of a value.
const FOLLOWED = ["status", "io"];
let followers = [];

function follow_all() {
    followers = FOLLOWED.map(follow);
}

function follow(command) {
    let rest = "";
    const follower = cockpit.spawn(["dpctl", "--json", command, "--follow"], { err: "message" });
    follower.stream(text => {
        if (!followers.includes(follower)) return; // closed meanwhile
        const parsed = parse_lines(rest + text);
        if (parsed === null) {
            ended("dpctl printed a line that is no document. The page asks it again.");
            return;
        }
        rest = parsed.rest;
        if (parsed.documents.length === 0) return;
        const before = picture;
        picture = parsed.documents.at(-1);
        show_picture();
        if (before === null || states(before) !== states(picture)) poll();
    });
    follower.then(() => ended("The connection to dpslaved ended."))
        .catch(failure => ended(failure_text(failure)));
    return follower;
}

const states = one => JSON.stringify(one.stations.map(({ name, state, drive }) => [name, state, drive.link]));

function ended(sentence) {
    if (followers.length === 0) return; // the end of one ended the other
    for (const follower of followers.splice(0)) follower.close("terminated");
    picture = null;
    show_bus(id("daemon"), null, sentence);
    show_stations(id("stations"), []);
    show_values(id("values"), []);
    id("doctor").replaceChildren();
    id("diagnosis").replaceChildren();
    window.setTimeout(follow_all, RETRY_MS);
}

function show_picture() {
    show_bus(id("daemon"), picture.bus, "");
    show_stations(id("stations"), picture.stations);
    const names = picture.stations.map(one => one.name);
    if (!names.includes(chosen)) chosen = names[0] ?? null;
    const select = id("station");
    if ([...select.options].map(one => one.value).join("\n") !== names.join("\n"))
        select.replaceChildren(...names.map(name => new Option(name, name)));
    select.value = chosen ?? "";
    show_values(id("values"), picture.words.find(one => one.name === chosen)?.words ?? []);
}

// ---- asked again and again

let polling = false;
async function poll() {
    if (polling || picture === null || document.hidden) return;
    polling = true;
    // One at a time: the daemon has few places for one user.
    const all = await ask(["show"]);
    const diagnosis = await ask(["diag"]);
    const doctor = await ask(["doctor"]);
    polling = false;
    if (picture === null) return;
    const stations = all?.stations ?? [];
    show_lamps(id("stations"), stations);
    show_tec(id("tec"), id("tec-name"), stations.find(one => one.station.name === chosen)?.tec ?? null);
    show_diagnosis(id("diagnosis"), diagnosis?.stations?.find(one => one.name === chosen) ?? null);
    show_doctor(id("doctor"), doctor);
}

// ---- the operator's commands

/// Shows what the command prints as it prints it: a search takes up to a minute. The printed text if the command did it;
/// null: it did not.
function operate(words) {
    const place = id("answer");
    let printed = "";
    show_answer(place, "...");
    return cockpit.spawn(["dpctl", ...words], { err: "out" })
        .stream(text => show_answer(place, printed += text))
        .then(() => {
            show_answer(place, printed);
            return printed;
        })
        .catch(failure => {
            show_answer(place, printed || failure_text(failure), failure.exit_status ?? -1);
            return null;
        })
        .finally(poll);
}

/// Asks before the machine may move. Escape and the button with the focus do nothing.
function ask_first(sentence, details, verb, action) {
    const question = id("question");
    id("question-text").textContent = sentence;
    id("question-details").textContent = details;
    id("question-do").textContent = verb;
    question.returnValue = "";
    question.onclose = () => {
        if (question.returnValue === "do") action();
    };
    question.showModal();
}
const of_station = () => (chosen === null ? [] : ["--station", chosen]);

/// The consent that dpctl asks for. It holds for one command only.
function consent() {
    const given = id("yes").checked;
    id("yes").checked = false;
    return given ? ["--yes"] : [];
}

id("station").addEventListener("change", event => {
    chosen = event.target.value;
    if (picture !== null) show_picture();
    poll();
});
id("access").addEventListener("submit", event => {
    event.preventDefault();
    operate(["read", ...of_station(), id("tag").value]);
});
id("write").addEventListener("click", () => {
    if (!id("access").reportValidity()) return;
    // What was asked is what is written, whatever is chosen or typed meanwhile.
    const words = ["write", ...of_station(), id("tag").value, id("value").value];
    ask_first(`Write ${id("value").value} to tag ${id("tag").value} of ${chosen ?? "the station"}? It goes to the drive at once.`, "",
              "Write", () => operate(words));
});
id("tec").addEventListener("submit", event => {
    event.preventDefault();
    operate(["tec", "set", ...consent(), ...of_station(), id("tec-name").value, id("tec-value").value]);
});
id("probe").addEventListener("click", () => operate(["doctor", "--probe", ...consent(), ...(chosen === null ? [] : [chosen])]));
id("reload").addEventListener("click", async () => {
    const would_do = await operate(["reload", "--dry-run"]);
    if (would_do === null) return; // refused: the answer says why
    ask_first("Reload the configuration? This is what it does:", would_do, "Reload", () => operate(["reload"]));
});

// ---- the configurator, where its package is installed

function link_configurator() {
    const folder = "../dpslaved-configurator/";
    if (!("dpslaved-configurator" in (cockpit.manifests ?? {}))) {
        id("configurator").textContent = "Install the package dpslaved-configurator to have it here.";
        return;
    }
    const link = document.createElement("a");
    link.href = folder + "configurator.html";
    link.target = "_blank";
    link.textContent = "Open the configurator";
    id("configurator").replaceChildren(link);
}

follow_all();
link_configurator();
window.setInterval(poll, POLL_MS);
document.addEventListener("visibilitychange", poll);
