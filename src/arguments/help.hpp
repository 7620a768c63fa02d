// SPDX-License-Identifier: Apache-2.0
/// The help of a program in 80 columns.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace CLI {
class FormatterBase;
} // namespace CLI

namespace dpslave::arguments {

std::shared_ptr<CLI::FormatterBase> help_formatter();

/// `text` in lines that fit the help. A line that is too long is broken at blanks. A command of an example
/// goes on behind a backslash, and its explanation stands below it.
std::string fitted(std::string_view text);

} // namespace dpslave::arguments
