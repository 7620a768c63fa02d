// SPDX-License-Identifier: Apache-2.0
// The structs of the replies against the description of the interface, and their way to JSON and back.
#include "control/varlink_reader.hpp"

#include "dpslave/report/replies.hpp"

#include <cxxabi.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <memory>
#include <typeinfo>

namespace dpslave {
namespace {

using namespace report;
using test::WrittenFields;

/// "Led" of dpslave::report::Led.
template <class T>
std::string name_of()
{
    const std::unique_ptr<char, decltype(&std::free)> name{
        abi::__cxa_demangle(typeid(T).name(), nullptr, nullptr, nullptr), &std::free};
    const std::string_view whole{name.get()};
    return std::string{whole.substr(whole.rfind(':') + 1)};
}

template <class T>
struct Written {
    static std::string text() { return name_of<T>(); }
};
template <>
struct Written<bool> {
    static std::string text() { return "bool"; }
};
template <>
struct Written<std::int64_t> {
    static std::string text() { return "int"; }
};
template <>
struct Written<double> {
    static std::string text() { return "float"; }
};
template <>
struct Written<std::string> {
    static std::string text() { return "string"; }
};
template <class T>
struct Written<std::optional<T>> {
    static std::string text() { return "?" + Written<T>::text(); }
};
template <class T>
struct Written<std::vector<T>> {
    static std::string text() { return "[]" + Written<T>::text(); }
};

/// The fields of T as a .varlink file would write them.
template <class T>
WrittenFields fields_of()
{
    WrittenFields fields;
    std::string_view names = T::kFields;
    T{}.with_fields([&](const auto&... each) {
        (fields.emplace_back(take_name(names), Written<std::decay_t<decltype(each)>>::text()), ...);
    });
    return fields;
}

using Described = std::map<std::string, WrittenFields>;

template <class... T>
Described described(const std::string& suffix = "")
{
    Described all;
    const auto add = [&](const std::string& name, WrittenFields fields) {
        all[name.substr(0, name.size() - suffix.size())] = std::move(fields);
    };
    (add(name_of<T>(), fields_of<T>()), ...);
    return all;
}

TEST(Replies, HaveAStructForEachTypeOfTheInterfaceWithItsFields)
{
    EXPECT_EQ(
        (described<Led, StationLeds, Drive, Ride, Station, Unanswered, Bus, Info, TecRow, Tec, Word, Demand,
                   StationIo, StationWords, DiagOctet, Refusal, Unscaled, Denied, RefusedTag, Diagnosis,
                   Counter, CounterGroup, DistributionClass, Distribution, Refresh, Log, Event, NamedTag,
                   Incident, TagSpan, RuleAnswers, Answering, LeavingStation, Member, Spacing, Sample>()),
        test::control_varlink().types);
}

TEST(Replies, HaveAStructForEachMethodOfTheInterface)
{
    EXPECT_EQ(
        (described<GetVersionReply, GetStatusReply, ListStationsReply, GetInfoReply, GetIoReply,
                   GetDiagnosisReply, GetCountersReply, GetBusReply, GetLedsReply, GetTecReply, WatchReply,
                   GetEventsReply, FindTagsReply, ReadTagReply, GetSurveyScopeReply, SurveyReply,
                   WriteTagReply, ProbeDriveReply, SetTecReply, SetLogLevelReply, ReloadReply, TraceReply,
                   ListIncidentsReply, GetIncidentReply, GetSamplesReply>("Reply")),
        test::control_varlink().outputs);
}

TEST(Replies, HaveAStructForEachErrorThatHasParameters)
{
    Described errors = test::control_varlink().errors;
    ASSERT_EQ(errors.erase("Busy"), 1U);
    ASSERT_EQ(errors.erase("ReadOnly"), 1U);
    ASSERT_EQ(errors.erase("TraceOff"), 1U);
    ASSERT_EQ(errors.erase("OnlyListens"), 1U);
    ASSERT_EQ(errors.erase("SamplesOff"), 1U);

    EXPECT_EQ((described<NoSuchStation, NoSuchLine, StationRequired, NotPermitted, DriveRefused, BadValue,
                         NoTecOption, BadTecValue, BadLogLevel, LineInUse, ProbeEnded, WouldSilence,
                         IncidentsOff, NoSuchIncident, IncidentUnreadable>()),
              errors);
}

const Json kWords = Json::parse(R"({"name": "unwinder", "words": [
    {"tag": 20, "name": null, "direction": "in", "octet": 0, "raw": 65535, "value": ">FFFF", "state": "good",
     "answer": null, "age_ms": 1.5}]})");

TEST(Replies, ComeBackFromJsonAsTheyWent)
{
    EXPECT_EQ(json_of(read<StationWords>(kWords)), kWords);
}

TEST(Replies, OfANewerDaemonMayHaveKeysThatAreNotKnown)
{
    Json newer = kWords;
    newer["words"][0]["colour"] = Json::object({{"red", 1}});

    EXPECT_EQ(json_of(read<StationWords>(newer)), kWords);
}

TEST(Replies, OfAnOlderDaemonLackKeysWhoseTextsAreUnknownAndWhoseOtherFieldsKeepTheirDefault)
{
    const Word word{.direction = "?", .value = "?", .state = "?"};

    EXPECT_EQ(read<StationWords>(Json::parse(R"({"words": [{}]})")), (StationWords{"?", {word}}));
    EXPECT_EQ(read<StationWords>(Json::parse(R"([1])")), (StationWords{"?", {}}));
}

TEST(Replies, WithAValueOfAnotherTypeAreReadAsIfItWereMissing)
{
    const auto word = read<Word>(Json::parse(R"({"tag": "20", "raw": 1.5, "value": 7, "age_ms": 2})"));

    EXPECT_EQ(word.tag, 0);
    EXPECT_EQ(word.raw, 0);
    EXPECT_EQ(word.value, "?");
    EXPECT_EQ(word.age_ms, 2.0);
    EXPECT_EQ(read<Bus>(Json::parse(R"({"unanswered": {"address": 1}, "port_open": 0})")),
              (Bus{.port = "?", .baud_state = "?"}));
}

} // namespace
} // namespace dpslave
