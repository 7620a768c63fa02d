// SPDX-License-Identifier: Apache-2.0
#include "drive_of_capture.hpp"

#include <algorithm>

namespace captures {

using namespace dpslave;

namespace {

using sim::Frame;

constexpr std::uint8_t kDl = 0x08, kDh = 0x0A;
constexpr std::uint8_t kExtDiag = 0x08, kStatDiag = 0x02; // wire reference 5.1
constexpr std::size_t kStandardDiagnosis = 6, kDemandOctets = 8;

std::optional<Frame> frame_of(const std::optional<sim::Octets>& octets)
{
    if (!octets) return std::nullopt;
    const auto length = sim::frame_length(*octets);
    if (!length || *length != octets->size()) return std::nullopt;
    const auto frame = sim::decode(*octets);
    return frame ? std::optional<Frame>{*frame} : std::nullopt;
}

bool has_inputs(const Frame& answer)
{
    return !answer.ssap && (answer.fc == kDl || answer.fc == kDh) && !answer.data.empty();
}

bool is_diagnosis(const Frame& answer)
{
    return answer.ssap == sim::kSapSlaveDiag && answer.data.size() >= kStandardDiagnosis;
}

bool begins_layout(const sim::ReplayStep& step)
{
    const auto request = frame_of(step.octets);
    return request && (request->dsap == sim::kSapSetPrm || request->dsap == sim::kSapChkCfg);
}

std::uint16_t word_at(const sim::Octets& data, std::size_t at)
{
    return static_cast<std::uint16_t>(data.at(at) << 8 | data.at(at + 1));
}

/// The failure that a code of Demand Data stands for (HA389815 ch. 7).
AccessError error_of(std::uint16_t code)
{
    return code == 0   ? AccessError::invalid_tag
           : code == 1 ? AccessError::read_only
                       : AccessError::out_of_range;
}

} // namespace

void DriveOfACapture::serve(std::size_t step)
{
    take_orders();
    set_diagnosis(step);
    set_inputs(step);
    const auto answer = frame_of(script_.steps[step].answer);
    if (answer && has_inputs(*answer)) answer_order(*answer);
}

void DriveOfACapture::take_orders()
{
    while (slave_.take_left()) {
    }
    while (const auto order = slave_.take_demand_order()) order_ = *order;
    if (const auto outputs = slave_.take_outputs()) layout_ = outputs->layout;
}

/// The blocks are there from the reply on that announces them, or else from the diagnosis on that has them.
void DriveOfACapture::set_diagnosis(std::size_t step)
{
    const auto answer = frame_of(script_.steps[step].answer);
    if (!answer || (answer->fc != kDh && !is_diagnosis(*answer))) return;
    const auto diagnosis = next_answer(step, is_diagnosis);
    if (!diagnosis || diagnosis->data.size() == kStandardDiagnosis) return;
    slave_.set_ext_diag(Bytes{diagnosis->data}.subspan(kStandardDiagnosis),
                        (diagnosis->data[0] & kExtDiag) != 0);
}

/// Where no reply follows that has inputs, they stay as they are.
void DriveOfACapture::set_inputs(std::size_t step)
{
    if (layout_.generation == 0) return;
    if (inputs_.generation != layout_.generation) inputs_ = {.generation = layout_.generation};
    const auto diagnosis = next_answer(step, is_diagnosis);
    inputs_.every_input_tried = !diagnosis || (diagnosis->data[1] & kStatDiag) == 0;
    if (const auto answer = next_answer(step, has_inputs); answer && answer->data.size() >= input_octets()) {
        std::size_t at = answer->data.size() - input_octets();
        for (std::size_t i = 0; i < layout_.count; ++i)
            if (layout_.parameters[i].reads) {
                inputs_.words[i] = word_at(answer->data, at);
                at += 2;
            }
    }
    slave_.set_inputs(inputs_);
}

/// Commands of the replies: 1 is a transfer, 7 a reject; an extended tag is in the second word.
void DriveOfACapture::answer_order(const Frame& answer)
{
    if (order_.kind == DemandOrder::Kind::cancel || answer.data.size() < input_octets() + kDemandOctets)
        return;
    const std::uint16_t first = word_at(answer.data, 0), value = word_at(answer.data, 6);
    const int command = first >> 12;
    const std::uint16_t tag = (first & 0x07FF) != 0 ? first & 0x07FF : word_at(answer.data, 2);
    if (tag != order_.tag || (command != 1 && command != 7)) return;
    slave_.set_demand_answer({.number = order_.number,
                              .error = command == 1 ? AccessError::none : error_of(value),
                              .value = value});
}

std::optional<Frame> DriveOfACapture::next_answer(std::size_t step, bool (*is_it)(const Frame&)) const
{
    for (std::size_t i = step; i < script_.steps.size(); ++i) {
        if (i > step && begins_layout(script_.steps[i])) break;
        auto answer = frame_of(script_.steps[i].answer);
        if (answer && is_it(*answer)) return answer;
    }
    return std::nullopt;
}

std::size_t DriveOfACapture::input_octets() const
{
    const auto* const begin = layout_.parameters.begin();
    return 2 *
           static_cast<std::size_t>(std::count_if(
               begin, begin + layout_.count, [](const LayoutEntry& parameter) { return parameter.reads; }));
}

} // namespace captures
