// SPDX-License-Identifier: Apache-2.0
#include "drive_view.hpp"

namespace dpslave::drive {
namespace {

bool is_refusal(AccessError error)
{
    return error != AccessError::none && error != AccessError::no_answer;
}

bool is_only_repeated(const AccessState& access, int repeats)
{
    return access.state == WordState::stale && access.failures > 0 && access.failures <= repeats;
}

void show_state(DriveSnapshot& snapshot, std::size_t i, const AccessState& access, int repeats)
{
    snapshot.states[i] = access.state;
    snapshot.errors[i] = access.error;
    snapshot.repeated[i] = is_only_repeated(access, repeats);
}

/// An output that was not written yet shows the answer of the drive.
void show_output(DriveSnapshot& snapshot, const Writing& output, const Reading* read, int repeats)
{
    const std::size_t i = output.parameter;
    snapshot.words[i] = output.word;
    snapshot.updated_at[i] = output.updated_at;
    if (read != nullptr) snapshot.answer_texts[i] = read->answer;
    const bool holds = read != nullptr && read->serves(kForm | kAsked) &&
                       output.state == WordState::untried &&
                       (read->state == WordState::unscaled || read->state == WordState::invalid_tag);
    show_state(snapshot, i, holds ? static_cast<const AccessState&>(*read) : output, repeats);
}

/// A parameter that is both read and written shows the refusal of a write, else the read.
void show_input(DriveSnapshot& snapshot, std::size_t i, bool is_output, const Reading& read, int repeats)
{
    snapshot.words[i] = read.word;
    snapshot.updated_at[i] = read.updated_at;
    snapshot.answer_texts[i] = read.answer;
    if (is_output && snapshot.states[i] != WordState::stale && is_refusal(snapshot.errors[i])) return;
    show_state(snapshot, i, read, repeats);
}

const Reading* reading_of(const ParameterSet& parameters, std::uint16_t tag)
{
    const DriveParameter* const one = parameters.find_read(tag);
    return one != nullptr ? &one->reading : nullptr;
}

/// Why the exchange must not begin.
StartHold hold_of(const DriveSettings& settings, const ParameterSet& parameters)
{
    using Denied = ParameterSet::Denied;
    if (settings.unscaled_holds && parameters.scale_missing()) return StartHold::unscaled;
    const Denied denied = parameters.denied();
    const bool holds = settings.denied_holds == DeniedHold::where_one   ? denied != Denied::none
                       : settings.denied_holds == DeniedHold::where_all ? denied == Denied::all
                                                                        : false;
    return holds ? StartHold::denied : StartHold::none;
}

} // namespace

void show_parameters(DriveSnapshot& snapshot, const Layout& layout, const ParameterSet& parameters,
                     int repeats)
{
    for (const DriveParameter& one : parameters.all())
        if (one.writing.is_output)
            show_output(snapshot, one.writing, reading_of(parameters, one.row->number), repeats);
    const std::span<const LayoutEntry> chosen = parameters_of(layout);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Reading* const read = chosen[i].reads ? reading_of(parameters, chosen[i].tag) : nullptr;
        if (read != nullptr) show_input(snapshot, i, chosen[i].writes, *read, repeats);
    }
}

/// A new layout reads them anew: until then, and while the drive is silent, the last word is shown.
void show_watched(DriveSnapshot& snapshot, const DriveTags& tags, const ParameterSet& parameters, int repeats)
{
    for (std::size_t i = 0; i < tags.watched().size(); ++i) {
        Watched& watched = snapshot.watched[i];
        watched.tag = tags.watched()[i];
        const Reading* const read = reading_of(parameters, watched.tag);
        if (read == nullptr || read->state == WordState::untried) continue;
        watched.state = read->state;
        watched.repeated = is_only_repeated(*read, repeats);
        if (read->state == WordState::good) watched.word = read->word;
    }
}

void count(DriveSnapshot& snapshot, const Transaction& transaction, AccessError error)
{
    if (error == AccessError::not_understood) ++snapshot.not_understood;
    if (error == AccessError::no_answer || error == AccessError::not_known)
        ++snapshot.silences;
    else if (error != AccessError::none)
        ++snapshot.refusals;
    else if (transaction.kind == Transaction::Kind::read)
        ++snapshot.reads;
    else if (transaction.kind == Transaction::Kind::write)
        ++snapshot.writes;
}

InputImage inputs(const Layout& layout, const ParameterSet& parameters, const DriveSettings& settings)
{
    InputImage image;
    image.generation = layout.generation;
    image.every_input_tried = parameters.every_input_tried();
    image.hold = hold_of(settings, parameters);
    const std::span<const LayoutEntry> chosen = parameters_of(layout);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (const Reading* const read = chosen[i].reads ? reading_of(parameters, chosen[i].tag) : nullptr)
            image.words[i] = read->word;
    return image;
}

} // namespace dpslave::drive
