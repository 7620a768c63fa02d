// SPDX-License-Identifier: Apache-2.0
/// A second, independent hand that reads a .varlink file: names and types as they are written, nothing
/// resolved.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace dpslave::test {

/// What is written between a pair of parentheses: "tag" -> "?int", "words" -> "[]Word", "x" -> "[](a: int)".
using WrittenFields = std::vector<std::pair<std::string, std::string>>;

struct WrittenInterface {
    std::string name;
    std::map<std::string, WrittenFields> types, inputs, outputs, errors;
};

/// Without comments. Throws std::runtime_error on anything unexpected.
WrittenInterface read_varlink(const std::string& text);

/// The text of org.dpslaved.Control.varlink in the source tree.
std::string control_varlink_file();
/// The same, read once.
const WrittenInterface& control_varlink();

/// Empty when `value` has exactly the written fields, each one present and of its type; else what is wrong
/// where.
std::string schema_fault(const WrittenInterface& interface, const WrittenFields& fields,
                         const nlohmann::json& value, const std::string& where = "reply");

} // namespace dpslave::test
