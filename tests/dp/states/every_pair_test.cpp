// SPDX-License-Identifier: Apache-2.0
/// Every trigger in every state: the answer and all that becomes another by it, as wire reference 6.3 and 6.4
/// say. Rows that need a whole start-up are in state_table_test.cpp and rows_exchange_test.cpp.
#include "dp/bench.hpp"
#include "dp/state_table.hpp"

#include <fmt/format.h>

namespace test {
namespace {

using dpslave::Bytes;
using dpslave::dp::Effect;
using dpslave::dp::Event;
using dpslave::dp::Judgement;
using dpslave::dp::LeaveReason;
using dpslave::dp::Snapshot;
using dpslave::dp::State;
using dpslave::dp::Trigger;
using dpslave::fdl::Answer;
using std::chrono::milliseconds;

/// A machine with an input 1234, an output A501 and the configuration 11 21 that it has accepted.
class Machine {
public:
    Machine(State in, Trigger next, bool diagnosis_pending)
    {
        happens(Trigger::start);
        asks({Trigger::prm_ok, parameters(1, milliseconds{200})}, "88 14 01 0C 47 11 01");
        asks({Trigger::cfg_ok, one_word_each_way()}, "11 21");
        data.set_inputs({.generation = 1, .every_input_tried = true, .words = {0x1234}});
        if (in == State::data_exch) {
            asks({Trigger::data_ok}, "A5 01");
            if (next == Trigger::inputs_ready) return; // it ends Stat_Diag
            happens(Trigger::inputs_ready);
            asks({Trigger::slave_diag}, "");
        } else if (in == State::power_on) {
            happens(Trigger::stop);
        } else {
            asks({Trigger::data_length}, "A5");
            if (in == State::wait_cfg)
                asks({Trigger::prm_ok, parameters(1, milliseconds{200})}, "88 14 01 0C 47 11 01");
        }
        if (diagnosis_pending) happens(Trigger::diagnosis_changed);
    }

    /// The octets of the request are long enough for each service: min T_SDR 100, Clear_Data.
    std::string asks(const Judgement& judged, std::string_view octets_of_it = "02 00 00 64 47 11 04")
    {
        const Octets octets_sent = octets(octets_of_it);
        dpslave::fdl::Indication request;
        request.sa = 2;
        request.data = octets_sent;
        dpslave::fdl::ReplyData reply;
        const Answer answer = machine.apply(judged, request, reply);
        const std::string with =
            reply.empty() ? "" : " " + show({reply.bytes().begin(), reply.bytes().end()});
        switch (answer) {
            case Answer::sc: return "SC" + with;
            case Answer::low: return "DL" + with;
            case Answer::high: return "DH" + with;
            case Answer::no_resource: return "RR" + with;
            case Answer::not_activated: return "RS" + with;
            case Answer::user_error: break;
        }
        return "UE" + with;
    }
    void happens(Trigger trigger) { machine.apply(trigger); }

    Snapshot seen() const
    {
        Snapshot snapshot;
        data.fill(snapshot);
        machine.fill(snapshot);
        return snapshot;
    }
    std::string accepted() const
    {
        const Bytes octets_accepted = machine.accepted_configuration();
        return show({octets_accepted.begin(), octets_accepted.end()});
    }
    /// Without the changes of the state.
    std::string logged()
    {
        std::string all;
        while (const auto event = log.take({}, {})) {
            if (event->kind == Event::Kind::refused) all += ", refused";
            if (event->kind == Event::Kind::foreign_set_prm)
                all += fmt::format(", tried by {}", event->master);
            if (event->kind == Event::Kind::clear_data) all += ", Clear_Data";
        }
        return all;
    }

    static dpslave::dp::SetPrm parameters(std::uint8_t groups, milliseconds watchdog)
    {
        dpslave::dp::SetPrm taken;
        taken.groups = groups;
        taken.watchdog_on = true;
        taken.watchdog = watchdog;
        return taken;
    }
    static dpslave::dp::Configuration one_word_each_way()
    {
        dpslave::dp::Configuration taken;
        taken.reads = true;
        taken.in_length = taken.out_length = 2;
        taken.layout.count = 2;
        taken.layout.parameters[0] = input(1);
        taken.layout.parameters[1] = output(2);
        // The words lie in the place of their parameter: the output is word 1.
        return taken;
    }

private:
    dpslave::dp::Personality device = example_device();
    dpslave::dp::ProcessData data{device};
    dpslave::dp::PendingEvents log;
    dpslave::dp::StateMachine machine{device, data, log};
};

/// As 6.3 names them.
std::string_view reason(LeaveReason why)
{
    switch (why) {
        case LeaveReason::none: return "none";
        case LeaveReason::prm_fault: return "prm";
        case LeaveReason::not_supported: return "unsupported";
        case LeaveReason::cfg_fault: return "cfg";
        case LeaveReason::watchdog: return "wd";
        case LeaveReason::unlock: return "unlock";
        case LeaveReason::output_length: return "length";
        case LeaveReason::new_parameters: return "new parameters";
        case LeaveReason::stop: return "stop";
    }
    return "?";
}

/// What is another than before, in the words of the reference.
std::string changes(const Snapshot& before, const Snapshot& now)
{
    std::string all;
    const auto tell = [&](bool changed, const std::string& what) {
        if (changed) all += ", " + what;
    };
    const auto bit = [](const Snapshot& of, std::size_t octet, unsigned mask) {
        return (of.diagnosis.bytes()[octet] & mask) != 0;
    };
    const auto became = [&](std::size_t octet, unsigned mask) {
        return !bit(before, octet, mask) && bit(now, octet, mask);
    };
    tell(now.state != before.state, "to " + std::string{text(now.state)});
    tell(now.left_because != before.left_because, fmt::format("L({})", reason(now.left_because)));
    tell(now.master != before.master, fmt::format("Master_Add {:02X}", now.master));
    tell(now.groups != before.groups, fmt::format("groups {:02X}", now.groups));
    tell(now.watchdog != before.watchdog, fmt::format("T_WD {}", now.watchdog.count()));
    tell(now.watchdog_on != before.watchdog_on, fmt::format("WD_On {}", now.watchdog_on ? 1 : 0));
    tell(now.min_tsdr != before.min_tsdr, fmt::format("minTSDR {}", now.min_tsdr.count));
    tell(became(0, 0x40), "Prm_Fault");
    tell(became(0, 0x10), "Not_Supported");
    tell(became(0, 0x04), "Cfg_Fault");
    tell(now.stat_diag != before.stat_diag, fmt::format("Stat_Diag {}", now.stat_diag ? 1 : 0));
    tell(now.diag_pending != before.diag_pending, fmt::format("Diag_Pending {}", now.diag_pending ? 1 : 0));
    tell(now.layout.generation != before.layout.generation, fmt::format("layout {}", now.layout.generation));
    tell(now.outputs != before.outputs, fmt::format("outputs {:04X}", now.outputs[1]));
    tell(now.counters.data_exchange != before.counters.data_exchange, "exchanged");
    return all;
}

/// What a trigger does, state by state. "D?" is DH while a diagnosis is pending, DL without one.
struct Pair {
    Trigger on;
    std::string power_on, wait_prm, wait_cfg, data_exch;
    const std::string& in(State state) const
    {
        switch (state) {
            case State::power_on: return power_on;
            case State::wait_prm: return wait_prm;
            case State::wait_cfg: return wait_cfg;
            case State::data_exch: break;
        }
        return data_exch;
    }
};

/// The leave procedure L of 6.3, without the fault bit, from each state that has an owner.
std::string left_wait_cfg(const std::string& reason, const std::string& fault = {})
{
    return ", to Wait_Prm, L(" + reason + "), Master_Add FF, groups 00, T_WD 0, WD_On 0" + fault +
           ", Diag_Pending 0";
}
std::string left_data_exch(const std::string& reason, const std::string& fault = {})
{
    return left_wait_cfg(reason, fault) + ", layout 0, outputs 0000";
}

const std::string kTaken = ", groups 04, T_WD 400, minTSDR 100";
const std::string kTakenByNewOwner =
    ", to Wait_Cfg, Master_Add 02, groups 04, T_WD 400, WD_On 1, minTSDR 100";

std::vector<Pair> reference()
{
    using enum Trigger;
    const std::string prm = ", Prm_Fault", unsupported = ", Not_Supported", cfg = ", Cfg_Fault";
    const std::string refused = ", refused";
    return {
        {start, ", to Wait_Prm, L(none), minTSDR 11, Get_Cfg ", "", "", ""}, // B1
        {stop, "", ", to Power_On, L(stop)",                                 // B2
         ", to Power_On, L(stop), Master_Add FF, groups 00, T_WD 0, WD_On 0, Diag_Pending 0",
         ", to Power_On, L(stop), Master_Add FF, groups 00, T_WD 0, WD_On 0, Diag_Pending 0, layout 0, "
         "outputs 0000"},
        {set_slave_add, "RS", "RS", "RS", "RS"}, // S3
        {slave_diag, "RS", "DL 02 05 00 FF 47 11", "DL 02 0C 00 02 47 11, Diag_Pending 0",
         "DL 00 0C 00 02 47 11, Diag_Pending 0"},                                                  // D1
        {slave_diag_with_data, "RS", "RR", "RR", "RR"},                                            // D1, 3.1
        {get_cfg, "RS", "DL 11 21", "DL 11 21", "DL 11 21"},                                       // D2
        {get_cfg_with_data, "RS", "RR", "RR", "RR"},                                               // D3
        {prm_short, "RS", "SC", "SC", "SC"},                                                       // P1
        {prm_foreign, "RS", "SC, tried by 2", "SC, tried by 2", "SC, tried by 2"},                 // P9
        {prm_min_tsdr, "RS", "SC, minTSDR 100", "SC, minTSDR 100", "SC, minTSDR 100"},             // P2
        {prm_unlock, "RS", "SC", "SC" + left_wait_cfg("unlock"), "SC" + left_data_exch("unlock")}, // P6, P10
        {prm_ok, "RS", "SC" + kTakenByNewOwner, "SC" + kTaken, "SC" + kTaken}, // P3, P7, P11
        {prm_other_tags, "RS", "SC" + kTakenByNewOwner, "SC" + kTaken,         // P3, P7, P12
         "SC, to Wait_Cfg, L(new parameters)" + kTaken + ", Diag_Pending 0, layout 0, outputs 0000"},
        {prm_bad, "RS", "SC" + prm + refused, // P4, P8
         "SC" + left_wait_cfg("prm", prm) + refused, "SC" + left_data_exch("prm", prm) + refused},
        {prm_unsupported, "RS", "SC" + unsupported + refused, // P5, P8
         "SC" + left_wait_cfg("unsupported", unsupported) + refused,
         "SC" + left_data_exch("unsupported", unsupported) + refused},
        {cfg_ok, "RS", "RS", // C1, C2, C4
         "SC, to Data_Exch, Stat_Diag 1, Diag_Pending 1, layout 2, Get_Cfg 02 00 00 64 47 11 04", "SC"},
        {cfg_bad, "RS", "RS", "SC" + left_wait_cfg("cfg", cfg) + refused, // C1, C3, C5
         "SC" + left_data_exch("cfg", cfg) + refused},
        {cfg_not_owner, "RS", "RS", "RS", "RS"},                               // C1, C6
        {data_ok, "RS", "RS", "RS", "D? 12 34, outputs 0200, exchanged"},      // X1, X2
        {data_empty, "RS", "RS", "RS", "D? 12 34, outputs 0000, exchanged"},   // X1, X3
        {data_length, "RS", "RS", "RS", "RS" + left_data_exch("length")},      // X1, X4
        {data_not_owner, "RS", "RS", "RS", "RS"},                              // X1, X5
        {read_inputs, "RS", "RS", "RS", "DL 12 34"},                           // R3, R1
        {read_outputs, "RS", "RS", "RS", "DL A5 01"},                          // R3, R1
        {read_back_with_data, "RS", "RS", "RS", "RR"},                         // R3, R2
        {other_sap, "RS", "RS", "RS", "RS"},                                   // M2
        {control, "", "", "", ", outputs 0000, Clear_Data"},                   // G2, G1
        {control_not_ours, "", "", "", ""},                                    // G2
        {watchdog_expired, "", "", left_wait_cfg("wd"), left_data_exch("wd")}, // W1
        {diagnosis_changed, "", "", ", Diag_Pending 1", ", Diag_Pending 1"},   // A1
        {inputs_ready, "", "", "", ", Stat_Diag 0, Diag_Pending 1"},           // A2
        {drive_gone, "", "", "", ", Stat_Diag 1, Diag_Pending 1"},             // A4
    };
}

/// 6.4 has a line and no answer for these.
bool is_answered(Trigger trigger)
{
    using enum Trigger;
    for (const Trigger one : {start, stop, control, control_not_ours, watchdog_expired, diagnosis_changed,
                              inputs_ready, drive_gone})
        if (trigger == one) return false;
    return true;
}

/// What is so already is no change, and a pending diagnosis makes the answer of an exchange high.
std::string expected_of(std::string row, bool pending)
{
    const std::string same = fmt::format(", Diag_Pending {}", pending ? 1 : 0);
    if (const auto at = row.find(same); at != std::string::npos) row.erase(at, same.size());
    if (const auto at = row.find("D?"); at != std::string::npos) row.replace(at, 2, pending ? "DH" : "DL");
    return row;
}

std::string done_by(Machine& machine, const Judgement& judged)
{
    machine.logged();
    const Snapshot before = machine.seen();
    const std::string accepted_before = machine.accepted();
    const std::string answer = machine.asks(judged);
    std::string all = is_answered(judged.trigger) ? answer : "";
    all += changes(before, machine.seen());
    if (machine.accepted() != accepted_before) all += ", Get_Cfg " + machine.accepted();
    return all + machine.logged();
}

/// What a telegram of this kind brings with it.
std::vector<Judgement> judgements(Trigger trigger)
{
    const Judgement parameters{trigger, Machine::parameters(4, milliseconds{400})};
    const Judgement configuration{trigger, Machine::one_word_each_way()};
    const Judgement refusal{trigger, dpslave::dp::RefusalDetail{dpslave::dp::Refusal::prm_ident, 5, 1, 2}};
    switch (trigger) {
        case Trigger::prm_ok:
        case Trigger::prm_other_tags: return {parameters};
        case Trigger::cfg_ok: return {configuration};
        default: return {{trigger}, parameters, configuration, refusal}; // none of them is taken
    }
}

TEST(EveryPair, OfStateAndTriggerDoesWhatTheReferenceSays)
{
    const std::vector<Pair> pairs = reference();
    ASSERT_EQ(pairs.size(), static_cast<std::size_t>(Trigger::count));
    for (const Pair& pair : pairs)
        for (const State in : {State::power_on, State::wait_prm, State::wait_cfg, State::data_exch})
            for (const bool wanted : {false, true})
                for (const Judgement& judged : judgements(pair.on)) {
                    Machine machine{in, pair.on, wanted};
                    const bool pending = machine.seen().diag_pending; // without an owner there is none
                    ASSERT_EQ(machine.seen().state, in);

                    EXPECT_EQ(done_by(machine, judged), expected_of(pair.in(in), pending))
                        << "trigger " << static_cast<int>(pair.on) << " in " << text(in);
                }
}

TEST(EveryPair, ThatTheReferenceGivesNoAnswerHasNoneInTheTable)
{
    using dpslave::dp::Reply;
    using dpslave::dp::row_of;
    EXPECT_EQ(row_of(State::power_on, Trigger::start).reply, Reply::none);
    for (const Pair& pair : reference())
        for (const State in : {State::wait_prm, State::wait_cfg, State::data_exch})
            EXPECT_EQ(row_of(in, pair.on).reply == Reply::none, !is_answered(pair.on))
                << "trigger " << static_cast<int>(pair.on) << " in " << text(in);
}

} // namespace
} // namespace test
