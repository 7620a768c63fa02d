// SPDX-License-Identifier: Apache-2.0
/// The page as the tests play it: the files of this tree under the page's names, requests and replies as
/// JSON.
#pragma once

#include "gsd/second_hand.hpp"

#include "dpslave/configurator/configurator.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace dpslave::test {

using nlohmann::json;

/// A text source: `index.txt`, profiles, tables and samples of this tree.
Result<std::string, Unreadable> shipped(const std::string& name);

json ask(const json& request);
json ask_text(const std::string& request); ///< of any octets

/// By the tests' own hand.
std::string to_base64(const std::string& octets);
std::string from_base64(const std::string& text);

/// `messages` or `refusals` of a reply, one after the other.
std::string texts(const json& reply, const char* key);

/// The GSD file that `make` replies.
std::string made_file(const json& mapping);

} // namespace dpslave::test
