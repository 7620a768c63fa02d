// SPDX-License-Identifier: Apache-2.0
#include "gsd_station.hpp"

#include "dpctl/cli/station_keys.hpp"

#include "dpslave/report/replies.hpp"

namespace dpslave::dpctl {
namespace {

std::uint32_t natural(std::int64_t value)
{
    return value > 0 && value <= 0x7FFF'FFFF ? static_cast<std::uint32_t>(value) : 0;
}

std::optional<std::uint32_t> natural(std::optional<std::int64_t> value)
{
    return value ? std::optional{natural(*value)} : std::nullopt;
}

/// Asks several methods; after the first failure none.
class Questions {
public:
    explicit Questions(Session& session) : session_(session) {}

    template <class Reply>
    Reply ask(std::string_view method, const Json& parameters = Json::object())
    {
        if (exit_) return {};
        const auto reply = session_.ask(method, parameters);
        if (reply) return report::read<Reply>(*reply);
        exit_ = reply.error();
        return {};
    }

    std::optional<int> exit() const { return exit_; }

private:
    Session& session_;
    std::optional<int> exit_;
};

template <class T>
const T* named(const std::vector<T>& all, const std::string& name)
{
    for (const T& one : all)
        if (one.name == name) return &one;
    return nullptr;
}

void take_bus(configurator::RunningStation& station, const report::GetStatusReply& status,
              const report::GetCountersReply& counters)
{
    station.baud = natural(status.bus.baud);
    if (const report::Station* one = named(status.stations, station.name))
        station.protocol = one->drive.protocol;
    for (const report::Distribution& turnaround : counters.turnaround) {
        if (turnaround.unit != "T_bit" || turnaround.count == 0) continue;
        station.usual_reply = natural(turnaround.p999);
        station.slowest_reply = natural(turnaround.highest);
    }
}

void take_diagnosis(configurator::RunningStation& station, const report::GetDiagnosisReply& reply)
{
    const report::Diagnosis* diagnosis = named(reply.stations, station.name);
    if (diagnosis == nullptr) return;
    station.last_prm = diagnosis->last_prm;
    station.last_cfg = diagnosis->last_cfg;
    for (const report::Unscaled& tag : diagnosis->unscaled)
        station.unscaled.push_back(static_cast<std::uint16_t>(natural(tag.tag)));
}

} // namespace

Result<FetchedStation, int> fetch_station(const std::string& name, Session& session)
{
    Questions questions{session};
    const Json which = station_parameter(name);
    const auto infos = questions.ask<report::GetInfoReply>("GetInfo", which);
    const auto status = questions.ask<report::GetStatusReply>("GetStatus");
    const auto diagnoses = questions.ask<report::GetDiagnosisReply>("GetDiagnosis", which);
    const auto counters = questions.ask<report::GetCountersReply>("GetCounters");
    if (questions.exit()) return Failure{*questions.exit()};
    if (infos.stations.empty()) {
        session.terminal().err << "dpctl: the daemon has no such station\n";
        return Failure{static_cast<int>(kUsage)};
    }
    const report::Info& info = infos.stations.front();
    FetchedStation fetched;
    configurator::RunningStation& station = fetched.station;
    station.name = info.name;
    station.profile = info.profile;
    station.keys = keys_of(info);
    for (std::size_t i = 0; i < info.bauds.size() && i < info.max_tsdr.size(); ++i)
        station.rates.emplace_back(natural(info.bauds[i]), natural(info.max_tsdr[i]));
    take_bus(station, status, counters);
    take_diagnosis(station, diagnoses);
    fetched.tag_table = info.tag_table;
    return fetched;
}

} // namespace dpslave::dpctl
