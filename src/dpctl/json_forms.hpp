// SPDX-License-Identifier: Apache-2.0
/// What --json prints where it is not the reply of one method: the forms, as --help tells them.
#pragma once

namespace dpslave::dpctl {

inline constexpr const char* kDoctorJson =
    R"({"findings": [FINDING], "notes": [FINDING], "line": null or LINE};
FINDING = {"station": null or name, "rule", "condition", "cause", "evidence", "steps": [text], "source"};
LINE = {"baud", "cable_a_m", "cable_b_m": null or metres};
with --all {"rules": [RULE], "lines": [LINE]}, where RULE is FINDING with "note", without "station" and "evidence")";

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
