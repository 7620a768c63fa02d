// SPDX-License-Identifier: Apache-2.0
/// One DP slave behind layer 2: Set_Prm, Chk_Cfg, Data_Exchange, Demand Data, Global_Control, several
/// masters, time. Judged from outside: who may change state, owner and outputs; what the outputs are; what a
/// reply has to say.
#include "input.hpp"

#include "dpslave/dp/slave.hpp"

#include <array>
#include <optional>
#include <vector>

namespace {

using namespace dpslave;
using dp::Personality;
using dp::Snapshot;
using dp::State;
using fuzz::demand;
using Octets = std::vector<std::uint8_t>;

/// HA389815: twelve tags, Demand Data, Sync and Freeze.
Personality option_board()
{
    Personality device;
    device.ident = 0x0533;
    device.max_tsdr.fill(Tbit{60});
    device.identifiers = {{0x50, true, false}, {0x60, false, true}};
    device.demand_identifier = 0x73;
    device.max_parameters = 12;
    device.prm = {.min_length = 24, .max_length = 24};
    device.demand = dp::DemandForm::basic;
    device.sync = true;
    device.freeze = true;
    return device;
}

/// HA463561: DPV1_Status, a parameter of both directions, an extended diagnosis.
Personality technology_box()
{
    Personality device = option_board();
    device.ident = 0x1649;
    device.identifiers.push_back({0x70, true, true});
    device.max_parameters = 30;
    device.prm = {.tags_at = 3,
                  .min_length = 3,
                  .max_length = 63,
                  .may_be_absent = true,
                  .dpv1_status = true,
                  .list = dp::TagList::zeros_at_end};
    device.max_diag_length = 10;
    device.diag_octets = 3;
    return device;
}

/// 2408f/2404f handbook: 117 words, extended Demand Data. With Fail_Safe, which no family has.
Personality controller()
{
    Personality device = option_board();
    device.ident = 0x2408;
    device.max_parameters = 117;
    device.max_words = 117;
    device.prm = {.min_length = 0, .max_length = 234, .max_tag = 16'383, .list = dp::TagList::exact};
    device.demand = dp::DemandForm::extended;
    device.sync = false;
    device.freeze = false;
    device.fail_safe = true;
    device.max_diag_length = 9;
    device.diag_octets = 2;
    return device;
}

const Personality& personality(std::uint8_t choice)
{
    static const std::array<Personality, 3> all{option_board(), technology_box(), controller()};
    return all[choice % all.size()];
}

std::uint16_t word_at(Bytes octets, std::size_t at)
{
    return static_cast<std::uint16_t>(octets[at] * 256 + octets[at + 1]);
}

enum class Did { other, set_prm, chk_cfg, data, control };

class Run {
public:
    explicit Run(const Personality& device) : device_(device), slave_(device, 5) { slave_.start(now_); }

    void step(fuzz::Input& input);

private:
    std::size_t outputs_expected() const
    {
        std::size_t octets = before_.demand_data ? 8 : 0;
        for (std::size_t i = 0; i < before_.layout.count; ++i)
            octets += before_.layout.parameters[i].writes ? 2u : 0u;
        return octets;
    }

    void ask(Did what, std::uint8_t sa, std::optional<std::uint8_t> dsap, std::optional<std::uint8_t> ssap,
             const Octets& data)
    {
        slave_.on_time(now_);
        before_ = slave_.snapshot();
        fdl::ReplyData reply;
        const auto answer = slave_.srd({sa, dsap, ssap, data, now_}, reply);
        const Snapshot after = slave_.snapshot();
        judge_states(what, sa, data, answer, after);
        judge_outputs(what, sa, data, answer, after);
        if (ssap == 62 || !dsap) judge_reply(dsap, answer, reply.bytes(), after);
        judge_orders(what, after);
    }

    void tell(std::uint8_t sa, const Octets& data)
    {
        slave_.on_time(now_);
        before_ = slave_.snapshot();
        slave_.sdn({sa, 58, 62, data, now_});
        const Snapshot after = slave_.snapshot();
        judge_states(Did::control, sa, data, fdl::Answer::sc, after);
        judge_outputs(Did::control, sa, data, fdl::Answer::sc, after);
        judge_orders(Did::control, after);
    }

    void judge_states(Did what, std::uint8_t sa, const Octets& data, fdl::Answer answer,
                      const Snapshot& after) const
    {
        if (after.state == State::data_exch && before_.state != State::data_exch)
            demand(what == Did::chk_cfg && before_.state == State::wait_cfg && sa == before_.master &&
                       answer == fdl::Answer::sc,
                   "Data_Exch is entered by the owner's Chk_Cfg alone");
        if ((after.state == State::wait_cfg && before_.state != State::wait_cfg) ||
            (after.master != before_.master && after.master != 0xFF)) {
            demand(what == Did::set_prm && sa == after.master,
                   "a master owns the slave by its Set_Prm alone");
            demand(data.size() >= 7 && (data[0] & 0xC0) == 0x80 && word_at(data, 4) == device_.ident,
                   "a Set_Prm that is accepted locks and has the ident");
        }
        if (after.state == State::data_exch) demand(after.master < 126, "who exchanges data has a master");
    }

    void judge_outputs(Did what, std::uint8_t sa, const Octets& data, fdl::Answer answer,
                       const Snapshot& after) const
    {
        const bool exchanged =
            what == Did::data && before_.state == State::data_exch && sa == before_.master &&
            (answer == fdl::Answer::low || answer == fdl::Answer::high || answer == fdl::Answer::sc) &&
            after.state == State::data_exch;
        const bool controlled =
            what == Did::control && sa == before_.master && before_.state == State::data_exch;
        // Row P11: a Set_Prm of the owner without Sync_Req ends Sync, and what was received goes out.
        const bool released = what == Did::set_prm && sa == before_.master &&
                              before_.state == State::data_exch && before_.sync && !after.sync &&
                              (data[0] & 0x20) == 0;
        const bool other_layout = after.layout.generation != before_.layout.generation;
        const auto are_zero = [&after] {
            return std::ranges::all_of(after.outputs, [](std::uint16_t word) { return word == 0; });
        };
        demand(exchanged || controlled || released || (!other_layout && after.outputs == before_.outputs) ||
                   ((other_layout || after.state != before_.state) && are_zero()),
               "outputs change by Data_Exchange or Global_Control of the owner alone");
        if (after.may_write && !before_.may_write)
            demand(exchanged || controlled || released, "writing begins with the owner's exchange");
        if (after.may_write) demand(after.state == State::data_exch, "only in Data_Exch is written");
        if (!exchanged || after.sync || after.clear || data.size() != outputs_expected()) return;
        std::size_t at = after.demand_data ? 8 : 0;
        for (std::size_t i = 0; i < after.layout.count; ++i) {
            if (!after.layout.parameters[i].writes) continue;
            demand(after.outputs[i] == word_at(data, at), "the outputs are the words of the Data_Exchange");
            at += 2;
        }
    }

    void judge_reply(std::optional<std::uint8_t> dsap, fdl::Answer answer, Bytes reply,
                     const Snapshot& after) const
    {
        if (answer != fdl::Answer::low && answer != fdl::Answer::high) {
            demand(reply.empty(), "an answer without data has none");
            return;
        }
        if (dsap == 60) {
            demand(reply.size() >= 6 && reply.size() <= device_.max_diag_length, "Slave_Diag has its length");
            demand(word_at(reply, 4) == device_.ident, "Slave_Diag has the ident");
            demand(reply[3] == before_.master, "Slave_Diag names the owner");
        }
        if (dsap == 57 || dsap == 56 || !dsap) {
            const bool outputs = dsap == 57;
            std::size_t at = after.demand_data ? 8 : 0;
            demand(reply.size() >= at, "Demand Data stands in front");
            for (std::size_t i = 0; i < after.layout.count; ++i) {
                const LayoutEntry& one = after.layout.parameters[i];
                if (!(outputs ? one.writes : one.reads)) continue;
                demand(reply.size() >= at + 2, "a reply has a word of each parameter");
                const std::uint16_t word = outputs ? after.outputs[i] : input_word(i, after);
                if (outputs || !after.freeze)
                    demand(word_at(reply, at) == word, "a reply has the words of its own layout");
                at += 2;
            }
            demand(reply.size() == at, "a reply has the configured length");
        }
    }

    std::uint16_t input_word(std::size_t i, const Snapshot& after) const
    {
        return given_.generation == after.layout.generation ? given_.words[i] : std::uint16_t{0};
    }

    void judge_orders(Did what, const Snapshot& after)
    {
        while (const auto order = slave_.take_demand_order()) {
            if (order->kind == DemandOrder::Kind::cancel) continue;
            last_order_ = order->number;
            const bool released = what == Did::set_prm && before_.sync && !after.sync; // row P11
            demand(what == Did::data || what == Did::control || released,
                   "a Demand Data order comes of an exchange");
            demand(after.state == State::data_exch && after.demand_data,
                   "an order stands in Data_Exch alone");
            demand(order->generation == after.layout.generation, "an order is of the present layout");
            if (after.sync || after.clear) continue;
            const auto& asked = after.demand_request;
            const std::uint16_t short_tag = asked[0] & 0x07FF;
            demand(order->tag == short_tag ||
                       (device_.demand == dp::DemandForm::extended && order->tag == asked[1]),
                   "an order has the tag of the registers");
            if (order->kind == DemandOrder::Kind::write)
                demand(order->value == asked[3], "an order writes the value of the registers");
        }
        if (const auto image = slave_.take_outputs()) {
            demand(!image->may_write || after.state == State::data_exch,
                   "what is to be written is exchanged");
            demand(!image->may_write || image->words == after.outputs, "what is to be written is in force");
        }
        while (slave_.take_left()) {
        }
        while (slave_.take_event()) {
        }
    }

    void give_inputs(fuzz::Input& input)
    {
        const Snapshot seen = slave_.snapshot();
        const bool present = input.octet() % 4 != 0;
        InputImage image;
        image.generation = present ? seen.layout.generation : seen.layout.generation + 1;
        image.every_input_tried = input.octet() % 4 != 0;
        image.words.fill(input.word());
        for (std::size_t i = 0; i < 8; ++i) image.words[i] = input.octet();
        slave_.set_inputs(image);
        if (present && image.generation != 0) given_ = image;
    }

    void pass_time(fuzz::Input& input)
    {
        now_ += std::chrono::milliseconds{input.octet() * 10};
        Instant last{};
        while (slave_.next_deadline() <= now_) {
            demand(slave_.next_deadline() > last, "a deadline moves on");
            last = slave_.next_deadline();
            slave_.on_time(last);
        }
    }

    const Personality& device_;
    dp::Slave slave_;
    Instant now_{std::chrono::seconds{100}};
    Snapshot before_;
    InputImage given_;
    std::uint32_t last_order_ = 0;
};

Octets rest_of(fuzz::Input& input)
{
    const auto octets = input.octets(input.octet() % 245);
    return {octets.begin(), octets.end()};
}

void Run::step(fuzz::Input& input)
{
    constexpr std::array<std::uint8_t, 4> masters{2, 2, 9, 125};
    const std::uint8_t op = input.octet(); // bits 3..0 what, 5..4 who
    const std::uint8_t sa = masters[op >> 4 & 3];
    switch (op & 15) {
        case 0: return ask(Did::set_prm, sa, 61, 62, rest_of(input));
        case 1: {
            Octets prm{static_cast<std::uint8_t>(0x80 | input.octet()),
                       input.octet(),
                       1,
                       11,
                       static_cast<std::uint8_t>(device_.ident >> 8),
                       static_cast<std::uint8_t>(device_.ident & 0xFF),
                       1};
            const Octets user = rest_of(input);
            prm.insert(prm.end(), user.begin(),
                       user.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(user.size(), 237)));
            if (device_.prm.min_length == 24) prm.resize(31);
            return ask(Did::set_prm, sa, 61, 62, prm);
        }
        case 2: return ask(Did::chk_cfg, sa, 62, 62, rest_of(input));
        case 3: return ask(Did::data, sa, std::nullopt, std::nullopt, rest_of(input));
        case 4: {
            before_ = slave_.snapshot();
            Octets data = rest_of(input);
            data.resize(outputs_expected());
            return ask(Did::data, sa, std::nullopt, std::nullopt, data);
        }
        case 5: return tell(sa, {input.octet(), input.octet()});
        case 6: return ask(Did::other, sa, 60, 62, {});
        case 7: return ask(Did::other, sa, 59, 62, {});
        case 8: return ask(Did::other, sa, 56, 62, {});
        case 9: return ask(Did::other, sa, 57, 62, {});
        case 10: return pass_time(input);
        case 11: return give_inputs(input);
        case 12:
            slave_.set_demand_answer({last_order_ + (input.octet() % 4 == 0 ? 1u : 0u),
                                      static_cast<AccessError>(input.octet() % 14), input.word()});
            return;
        case 13: {
            const Octets blocks = rest_of(input);
            slave_.set_ext_diag(blocks, input.octet() % 2 != 0);
            return;
        }
        case 14: return slave_.heard(sa, now_);
        default: return ask(Did::other, sa, input.octet() & 63, input.octet() & 63, rest_of(input));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Input input{data, size};
    Run run{personality(input.octet())};
    while (!input.at_end()) run.step(input);
    return 0;
}
