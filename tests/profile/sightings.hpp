// SPDX-License-Identifier: Apache-2.0
/// Answers of a drive as a survey gets them.
#pragma once

#include "dpslave/profile/survey.hpp"

#include <initializer_list>

namespace dpslave::test {

/// A tag that gave these answers over EI-ASCII.
inline profile::Sighting saw(std::initializer_list<const char*> answers, const char* mnemonic = "")
{
    profile::Sighting one;
    one.mnemonic = mnemonic;
    for (const char* const answer : answers) one.add({profile::SurveyAnswer::Kind::text, answer, 0});
    return one;
}

inline profile::SurveyAnswer said(const char* text)
{
    return {profile::SurveyAnswer::Kind::text, text, 0};
}
inline profile::SurveyAnswer said(std::uint16_t word)
{
    return {profile::SurveyAnswer::Kind::word, "", word};
}
inline profile::SurveyAnswer denied(const char* why)
{
    return {profile::SurveyAnswer::Kind::denied, why, 0};
}
inline profile::SurveyAnswer silence()
{
    return {};
}

} // namespace dpslave::test
