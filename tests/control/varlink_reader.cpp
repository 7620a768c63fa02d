// SPDX-License-Identifier: Apache-2.0
#include "varlink_reader.hpp"

#include "support/paths.hpp"

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dpslave::test {
namespace {

/// "a: int, b: (c: d, e: f)" cut at the commas of the outermost level.
std::vector<std::string> cut(const std::string& text)
{
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : text) {
        if (c == '(') ++depth;
        if (c == ')') --depth;
        if (c == ',' && depth == 0)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    if (parts.back().empty()) parts.pop_back();
    return parts;
}

WrittenFields fields_of(const std::string& text)
{
    WrittenFields result;
    for (const std::string& part : cut(text)) {
        const auto colon = part.find(':');
        if (colon == std::string::npos) throw std::runtime_error("no type: " + part);
        result.emplace_back(part.substr(0, colon), part.substr(colon + 1));
    }
    return result;
}

/// The text between the parenthesis at `at` and its partner; `at` moves behind it.
std::string inside(const std::string& text, std::size_t& at)
{
    if (text.at(at) != '(') throw std::runtime_error("'(' expected: " + text.substr(at, 30));
    const std::size_t start = ++at;
    for (int depth = 1; depth > 0; ++at) {
        if (text.at(at) == '(') ++depth;
        if (text.at(at) == ')') --depth;
    }
    return text.substr(start, at - 1 - start);
}

std::string type_fault(const WrittenInterface& interface, std::string type, const nlohmann::json& value,
                       const std::string& where)
{
    if (type.front() == '?') {
        if (value.is_null()) return {};
        type.erase(0, 1);
    }
    if (type.rfind("[]", 0) == 0) {
        if (!value.is_array()) return where + " is no array";
        for (const auto& item : value)
            if (auto fault = type_fault(interface, type.substr(2), item, where + "[]"); !fault.empty())
                return fault;
        return {};
    }
    if (type.front() == '(')
        return schema_fault(interface, fields_of(type.substr(1, type.size() - 2)), value, where);
    const bool fits = type == "int"      ? value.is_number_integer()
                      : type == "float"  ? value.is_number()
                      : type == "bool"   ? value.is_boolean()
                      : type == "string" ? value.is_string()
                                         : interface.types.count(type) == 1;
    if (!fits) return where + " is no " + type;
    const auto named = interface.types.find(type);
    return named == interface.types.end() ? std::string{}
                                          : schema_fault(interface, named->second, value, where);
}

} // namespace

WrittenInterface read_varlink(const std::string& text)
{
    WrittenInterface result;
    std::string all = std::regex_replace(text, std::regex("#[^\n]*"), "");
    std::smatch head;
    if (!std::regex_search(all, head, std::regex(R"(^\s*interface\s+([A-Za-z0-9.]+)\s)")))
        throw std::runtime_error("no interface");
    result.name = head[1];
    all = head.suffix();
    const std::regex member(R"(^\s*(type|method|error)\s+([A-Za-z0-9]+)\s*)");
    for (std::smatch found; std::regex_search(all, found, member);) {
        const std::string kind = found[1], name = found[2];
        std::string rest = std::regex_replace(found.suffix().str(), std::regex(R"(\s*->\s*)"), ">",
                                              std::regex_constants::format_first_only);
        std::size_t at = 0;
        const auto squeezed = [](const std::string& s) {
            return std::regex_replace(s, std::regex(R"(\s+)"), "");
        };
        const auto first = fields_of(squeezed(inside(rest, at)));
        if (kind == "type") result.types[name] = first;
        if (kind == "error") result.errors[name] = first;
        if (kind == "method") {
            result.inputs[name] = first;
            if (rest.at(at) != '>') throw std::runtime_error("'->' expected after " + name);
            ++at;
            result.outputs[name] = fields_of(squeezed(inside(rest, at)));
        } else {
            rest = found.suffix().str(); // its arrows belong to the members behind
        }
        all = rest.substr(at);
    }
    if (all.find_first_not_of(" \t\n") != std::string::npos)
        throw std::runtime_error("unexpected: " + all.substr(0, 40));
    return result;
}

std::string control_varlink_file()
{
    std::ifstream file(source_path("include/dpslave/control/org.dpslaved.Control.varlink"));
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

const WrittenInterface& control_varlink()
{
    static const WrittenInterface interface = read_varlink(control_varlink_file());
    return interface;
}

std::string schema_fault(const WrittenInterface& interface, const WrittenFields& fields,
                         const nlohmann::json& value, const std::string& where)
{
    if (!value.is_object()) return where + " is no object";
    std::set<std::string> documented;
    for (const auto& [name, type] : fields) {
        documented.insert(name);
        if (!value.contains(name)) return where + " has no " + name;
        if (auto fault = type_fault(interface, type, value.at(name), where + "." + name); !fault.empty())
            return fault;
    }
    for (const auto& item : value.items())
        if (documented.count(item.key()) == 0) return where + " has an undocumented " + item.key();
    return {};
}

} // namespace dpslave::test
