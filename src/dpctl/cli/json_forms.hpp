// SPDX-License-Identifier: Apache-2.0
/// What --json prints where it is not the reply of one method: the forms, as --help shows them.
#pragma once

namespace dpslave::dpctl {

inline constexpr const char* kShowJson =
    R"({"version", "stations": [{"station": Station, "info": Info, "leds": StationLeds, "tec": null or Tec}]},
with the types of org.dpslaved.Control.varlink)";

inline constexpr const char* kDoctorJson =
    R"({"findings": [FINDING], "notes": [FINDING], "earlier": [EARLIER], "line": null or LINE};
FINDING = {"station": null or name, "rule", "condition", "cause", "evidence", "steps": [text], "source"};
EARLIER = {"station": null or name, "what", "count", "age_ms"};
LINE = {"baud", "cable_a_m", "cable_b_m": null or metres};
with --all {"rules": [RULE], "lines": [LINE]}, where RULE is FINDING with "note", without "station" and "evidence")";

inline constexpr const char* kTraceJson =
    R"({"what": "telegram", "piece", "reply", "unanswered", "rate" or "lost", "at_ns", "first_ns", "last_ns": since 1970,
"uncertainty_ns", "baud", "from", "to": null or address, "service", "octets": hexadecimal, "bad_characters",
"flaw": null or code, "lost": records, "note": text, of telegrams that were before; with --decode "decoded": null or
{"kind", "hex", "lines": [{"name", "value"}], "octets": [{"octet", "offset", "value", "meaning"}], "faults": [text]}}, one a line;
with --incidents the reply of ListIncidents; with --incident first {"what": "incident", "incident": its head})";

inline constexpr const char* kSurveyJson =
    R"({"station", "table", "record": files, "complete": true or false, "tags": how many there are to ask,
"asked", "answering", "denied": [{"reason", "tags": [number]}], "silent": [number], "added": [number],
"waiting": [number], "contradictions": [text]})";

inline constexpr const char* kTuneJson =
    R"({"machine": {"kernel", "preempt_rt", "threaded_irqs", "rt_runtime_us", "processors", "isolated",
"governors": [name], "idle_exit_us", "latency_limit_us", "virtual_machine"},
"port": {"path", "name", "uart", "driver", "usb", "clock_hz", "fifo", "trigger", "latency_timer_ms", "dma", "irq",
"irq_thread": null or THREAD},
"daemon": null or {"pid", "baud", "bus_thread": null or THREAD, "locked_kib", "replies", "too_late", "overtaken",
"repeated", "p999_us", "highest_us", "page_faults"},
"rates": [{"baud", "verdict": "holds", "doubtful" or "cannot", "needed_tbit", "promised_tbit",
"error_percent", "reason"}],
"findings": [{"severity": "mend", "better" or "know", "name", "what", "cost", "steps": [text]}]};
THREAD = {"id", "name", "policy", "priority", "cpus"}; what could not be found out is null)";

inline constexpr const char* kTopJson =
    R"({"status": the reply of GetStatus, "counters": of GetCounters, "io": of GetIo, "events": of GetEvents};
with --every one a line, and of the events only the newest)";

inline constexpr const char* kMetricsJson =
    R"({"version": the reply of GetVersion, "status": of GetStatus, "counters": of GetCounters})";

inline constexpr const char* kTagJson =
    R"({"tags": [{"table", "tag", "hex", "name", "aliases": [text], "type", "decimals", "follows_display", "unsigned",
"min", "max": null or as displayed, "access", "mnemonic": null or text, "modbus_register", "demand_data": null or
{"read", "write": words in hexadecimal, "extended": true or false}, "values", "bits": [{"number", "text"}], "section", "notes"}]};
without WHAT {"tables": [{"table", "tags", "profiles": [name]}], "without": [{"profile", "device"}]})";

inline constexpr const char* kHexJson =
    R"({"numbers": [{"text", "value": 0..65535, "signed", "hex", "octets": [high, low]}]})";

inline constexpr const char* kDecodeJson =
    R"({"parts": [{"kind", "hex", "lines": [{"name", "value"}], "octets": [{"octet", "offset", "value", "meaning"}],
"faults": [text]}]})";

} // namespace dpslave::dpctl
