// SPDX-License-Identifier: Apache-2.0
#include "master.hpp"

#include <fmt/format.h>

namespace dpslave::sim {
namespace {

/// A slave that refuses is asked again after this time: fast enough to be seen healing, slow enough to be
/// read.
constexpr auto kRefusalPause = std::chrono::milliseconds{500};

} // namespace

/// What a slave must not do, whatever it says (wire reference 2.2, 2.4, 2.5).
std::string Master::flaw_of(const Frame& frame) const
{
    if (frame.kind == FrameKind::short_ack) return {};
    if (frame.kind == FrameKind::token) return "a token, but a slave has none";
    if ((frame.fc & 0x40) != 0) return "it has the form of a request";
    if (frame.sa != settings_.slave) return fmt::format("it comes from station {}", frame.sa);
    if (frame.da != settings_.address) return fmt::format("it goes to station {}", frame.da);
    if ((frame.fc & 0xB0) != 0) return fmt::format("FC {:02X}: a slave's station type is 00", frame.fc);
    if (frame.kind == FrameKind::no_data) return {};
    const bool expects_sap = pending_->order.service != Service::data_exchange;
    if (expects_sap && (frame.ssap != sap_of(pending_->order.service) || frame.dsap != kSapMaster))
        return "the SAPs are not those of the request, exchanged";
    if (!expects_sap && (frame.ssap || frame.dsap)) return "SAPs in an answer of the default SAP";
    return {};
}

void Master::handle(const Frame& frame, Instant now)
{
    const Service service = pending_->order.service;
    const bool one_shot = pending_->one_shot;
    const bool negative =
        frame.kind == FrameKind::no_data && (frame.fc & 0x0F) >= 1 && (frame.fc & 0x0F) <= 3;
    if (negative) return on_negative(frame, now);
    switch (service) {
        case Service::fdl_status:
            if (state_ == MasterState::searching && !one_shot && frame.kind == FrameKind::no_data) {
                first_ = true;
                enter(MasterState::asking);
            }
            return;
        case Service::slave_diag: return on_slave_diag(frame, now);
        case Service::set_prm:
        case Service::chk_cfg:
            if (frame.kind != FrameKind::short_ack)
                complain(fmt::format("{} is answered with {} instead of SC", text(service), describe(frame)));
            else if (!one_shot && state_ == MasterState::parameterising)
                enter(MasterState::configuring);
            else if (!one_shot && state_ == MasterState::configuring)
                enter(MasterState::awaiting_ready);
            return;
        case Service::data_exchange: return on_data_exchange(frame, now);
        case Service::get_cfg:
        case Service::global_control:
        case Service::raw: return;
    }
}

void Master::on_negative(const Frame& frame, Instant now)
{
    ++counters_.refused;
    if (pending_->one_shot || state_ == MasterState::stopped) return;
    auto words = fmt::format("{} is answered with {}", text(pending_->order.service), describe(frame));
    if (state_ == MasterState::data_exchange)
        return leave_exchange(words + ": the slave is not in data exchange any more", MasterState::asking);
    if (state_ != MasterState::configuring) return refuse(std::move(words), now);
    cfg_refusal_ = std::move(words); // the reason stands in the diagnosis
    enter(MasterState::awaiting_ready);
}

void Master::on_slave_diag(const Frame& frame, Instant now)
{
    ++counters_.diagnosis_reads;
    if (frame.kind == FrameKind::short_ack || frame.kind == FrameKind::no_data || (frame.fc & 0x0F) != 0x08)
        return complain("Slave_Diag is answered with " + describe(frame) + " instead of DL");
    auto diagnosis = parse_diagnosis(frame.data);
    if (!diagnosis) return complain(diagnosis.error());
    diagnosis_ = std::move(*diagnosis);
    if (pending_->one_shot && state_ != MasterState::data_exchange) return;
    if (state_ == MasterState::data_exchange && told_diagnosis_ != diagnosis_->octets) {
        told_diagnosis_ = diagnosis_->octets;
        if (!pending_->one_shot) events_.push_back({MasterEvent::Kind::diagnosis, {}, std::nullopt});
    }
    judge_start_up(*diagnosis_, now);
}

void Master::judge_start_up(const Diagnosis& d, Instant now)
{
    const bool foreign = d.master != 0xFF && d.master != settings_.address;
    switch (state_) {
        case MasterState::asking:
            if (foreign) return refuse(fmt::format("the slave belongs to master {}", d.master), now);
            cfg_refusal_.clear();
            return enter(MasterState::parameterising);
        case MasterState::awaiting_ready:
            if (d.prm_fault() && d.ident != settings_.ident)
                return refuse(
                    fmt::format(
                        "Set_Prm was refused: its ident is 0x{:04X}, the slave's is 0x{:04X} (--ident)",
                        settings_.ident, d.ident),
                    now);
            if (d.prm_fault())
                return refuse(
                    fmt::format("Set_Prm was refused: the slave does not like User_Prm_Data ({} octets: {})",
                                settings_.user_prm.size(), hex(settings_.user_prm)),
                    now);
            if (d.not_supported())
                return refuse("Set_Prm was refused: Sync or Freeze is not supported (--no-sync-freeze)", now);
            if (d.cfg_fault())
                return refuse("Chk_Cfg was refused: Cfg_Data " + hex(settings_.cfg) + " does not fit", now);
            if (foreign) return refuse(fmt::format("the slave now belongs to master {}", d.master), now);
            if (d.prm_required()) return refuse("the slave has dropped its parameters again", now);
            if (!cfg_refusal_.empty()) return refuse(cfg_refusal_, now);
            if (d.not_ready() || d.stat_diag()) return;
            enter(MasterState::data_exchange);
            orders_.push_front(
                {Service::global_control, {static_cast<std::uint8_t>(clear_ ? 0x02 : 0x00), 0x00}});
            return;
        case MasterState::data_exchange:
            diagnosis_due_ = d.stat_diag();
            if (d.not_ready() || d.prm_required() || foreign)
                leave_exchange("diagnosis says that the slave is not in data exchange any more",
                               MasterState::asking);
            return;
        default: return;
    }
}

void Master::on_data_exchange(const Frame& frame, Instant now)
{
    const unsigned function = frame.fc & 0x0FU;
    const bool high_priority = frame.kind != FrameKind::short_ack && function == 0x0A;
    const bool data = frame.kind == FrameKind::variable || frame.kind == FrameKind::fixed;
    const bool fits = lengths_.inputs == 0 ? !data : data && frame.data.size() == lengths_.inputs;
    if (state_ != MasterState::data_exchange) return;
    if (!fits || (data && function != 0x08 && !high_priority))
        return leave_exchange(
            fmt::format("Data_Exchange should bring {} octets, but {}", lengths_.inputs, describe(frame)),
            MasterState::asking);
    inputs_ = frame.data;
    if (high_priority) {
        ++counters_.diagnosis_pending;
        diagnosis_due_ = true;
    }
    const auto took = now - pending_->sent;
    counters_.answer_min = counters_.cycles == 0 ? took : std::min(counters_.answer_min, took);
    counters_.answer_max = std::max(counters_.answer_max, took);
    counters_.answer_sum += took;
    ++counters_.cycles;
}

void Master::refuse(std::string why, Instant now)
{
    if (why != last_refusal_) events_.push_back({MasterEvent::Kind::refused, why, std::nullopt});
    last_refusal_ = std::move(why);
    next_cycle_ = now + kRefusalPause;
    state_ = MasterState::asking;
}

void Master::leave_exchange(std::string why, MasterState to)
{
    if (state_ == MasterState::data_exchange) ++counters_.exchanges_lost;
    events_.push_back({MasterEvent::Kind::lost, std::move(why), std::nullopt});
    enter(to);
}

void Master::enter(MasterState state)
{
    if (state == state_) return;
    if (state_ == MasterState::data_exchange) inputs_.clear(); // old values must not pass for present ones
    state_ = state;
    if (state == MasterState::data_exchange) {
        diagnosis_due_ = false;
        told_diagnosis_.clear();
        last_refusal_.clear();
    }
    events_.push_back({MasterEvent::Kind::state, std::string{text(state)}, std::nullopt});
}

void Master::complain(std::string words)
{
    events_.push_back({MasterEvent::Kind::complaint, std::move(words), std::nullopt});
}

void Master::report(Answer answer)
{
    std::string words = answer.words;
    events_.push_back({MasterEvent::Kind::answer, std::move(words), std::move(answer)});
}

} // namespace dpslave::sim
