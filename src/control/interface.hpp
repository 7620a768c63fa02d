// SPDX-License-Identifier: Apache-2.0
/// A Varlink interface description, read: what methods there are and whether a JSON value has the described
/// type. Pure. The server judges calls with it; the tests of other libraries can judge their replies with it.
#pragma once

#include "dpslave/control/protocol.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::control {

inline constexpr std::string_view kServiceInterface = "org.varlink.service";

/// org.dpslaved.Control.varlink and the standard's org.varlink.service, as texts.
std::string_view interface_text() noexcept;
std::string_view service_interface_text() noexcept;

struct Field;
/// The fields of an object.
using Struct = std::vector<Field>;

/// A type of the description.
struct Type {
    enum class Kind : std::uint8_t {
        boolean,
        integer,
        number,
        string,
        object,
        array,
        map,
        structure,
        enumeration,
        named
    };
    Kind kind = Kind::object;
    bool nullable = false;             ///< "?"
    std::shared_ptr<const Type> inner; ///< of an array or map
    Struct fields;                     ///< of a structure
    std::vector<std::string> words;    ///< of an enumeration
    std::string name;                  ///< of a named type
};
struct Field {
    std::string name;
    Type type;
};

struct MethodType {
    Struct in, out;
};

struct Interface {
    std::string name;
    std::map<std::string, Type, std::less<>> types;
    std::map<std::string, MethodType, std::less<>> methods;
    std::map<std::string, Struct, std::less<>> errors;
};

/// Reads a description. The reason of a failure is "line 12: what is wrong".
Result<Interface, std::string> parse_interface(std::string_view text);

/// Does `value` have exactly the described fields? None = yes; else the path of the first field that is
/// missing, unknown or of another type: "stations[0].drive.link". A nullable field may be missing.
std::optional<std::string> mismatch(const Interface& interface, const Struct& fields, const Json& value);

/// mismatch() for the parameters of a reply of org.dpslaved.Control: none = as described.
std::optional<std::string> reply_mismatch(std::string_view method, const Json& parameters);

} // namespace dpslave::control
