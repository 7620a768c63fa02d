// SPDX-License-Identifier: Apache-2.0
/// The outputs of which a line cannot prove at its end that they have their safe state, in words.
#include "app/line/line_unit.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

TEST(ZerosLeft, AreSaidAsNotWrittenOrAsWrittenAndNotReadBack)
{
    EXPECT_EQ(zeros_in_words({}), "");
    EXPECT_EQ(zeros_in_words({{.tag = 56, .is_written = false}}), "tag 56 was not written");
    EXPECT_EQ(zeros_in_words({{56, true}, {57, true}}), "tags 56, 57 were written and not read back");
    EXPECT_EQ(zeros_in_words({{56, true}, {57, false}, {58, true}}),
              "tag 57 was not written; tags 56, 58 were written and not read back");
}

} // namespace
} // namespace dpslave::app
