// SPDX-License-Identifier: Apache-2.0
/// Tests which answer belongs to which request: the pure client on a line whose slave says what the test has
/// written down, as late as the test wants. The line has the only clock.
#include "dpslave/modbus/modbus_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>

namespace dpslave::modbus {
namespace {

using namespace std::chrono_literals;
using drive::Tag;
using testing::ElementsAre;
using testing::IsEmpty;

using Octets = std::vector<std::uint8_t>;

Octets octets(const std::string& text)
{
    Octets out;
    for (std::size_t i = 0; i + 1 < text.size(); i += 3)
        out.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
    return out;
}

/// Frames without checksum, unit first.
class WrittenLine final : public ModbusPort {
public:
    struct Saying {
        std::string frame; ///< empty: something broken
        std::chrono::nanoseconds after{};
    };
    void answers(std::vector<Saying> what) { script_.push_back(std::move(what)); }
    void answers(const std::string& frame, std::chrono::nanoseconds after = 10ms)
    {
        answers(std::vector{Saying{frame, after}});
    }
    void is_silent() { script_.emplace_back(); }
    bool echoes = false;
    bool stalls = false; ///< send() fails, and the request leaves all the same
    Instant time{};
    std::vector<std::string> asked; ///< unit and request

    bool send(std::uint8_t unit, Bytes pdu) override
    {
        Octets request{unit};
        request.insert(request.end(), pdu.begin(), pdu.end());
        asked.push_back(text(request));
        if (echoes) coming_.push_back({request, time + 1ms});
        if (script_.empty()) return !stalls;
        for (const Saying& one : script_.front()) coming_.push_back({octets(one.frame), time + one.after});
        script_.pop_front();
        return !stalls;
    }
    bool may_have_left() const override { return stalls; }
    Heard receive(Instant until) override
    {
        const auto next = std::min_element(coming_.begin(), coming_.end(),
                                           [](const auto& a, const auto& b) { return a.at < b.at; });
        if (next == coming_.end() || next->at > until) {
            time = std::max(time, until);
            return Heard::silence;
        }
        time = std::max(time, next->at);
        frame_ = next->frame;
        coming_.erase(next);
        return frame_.empty() ? Heard::broken : Heard::frame;
    }
    Bytes frame() const override { return frame_; }
    Instant now() const override { return time; }

private:
    struct Coming {
        Octets frame;
        Instant at{};
    };
    static std::string text(const Octets& what)
    {
        std::string out;
        for (const std::uint8_t octet : what) {
            constexpr const char* kDigits = "0123456789ABCDEF";
            if (!out.empty()) out += ' ';
            out += kDigits[octet >> 4];
            out += kDigits[octet & 15];
        }
        return out;
    }
    std::deque<std::vector<Saying>> script_;
    std::vector<Coming> coming_;
    Octets frame_;
};

Tag tag(std::uint16_t number)
{
    Tag row;
    row.number = number;
    return row;
}

class ModbusAnswers : public testing::Test {
protected:
    explicit ModbusAnswers(ModbusDrive unit = {.unit = 1}, EchoMode echo = EchoMode::off)
    {
        ClientSettings settings;
        settings.timeout = 600ms;
        settings.rules.echo = echo;
        settings.units = {unit};
        client.emplace(line, settings);
    }
    AccessError read(std::uint16_t number, std::uint16_t count = 1, std::uint8_t unit = 1)
    {
        words.assign(count, 0xDEAD);
        return client->read({.unit = unit}, tag(number), words);
    }
    AccessError write(std::uint16_t number, std::uint16_t word)
    {
        return client->write({.unit = 1}, tag(number), {&word, 1});
    }
    WrittenLine line;
    std::optional<ModbusClient> client;
    std::vector<std::uint16_t> words;
};
class ModbusAnswersOf2400 : public ModbusAnswers {
protected:
    ModbusAnswersOf2400() : ModbusAnswers({.unit = 1, .reads_by_4 = true, .has_loopback = true}) {}
};
class ModbusAnswersWithLoopback : public ModbusAnswers {
protected:
    ModbusAnswersWithLoopback() : ModbusAnswers({.unit = 1, .has_loopback = true}) {}
};
class ModbusEcho : public ModbusAnswers {
protected:
    ModbusEcho() : ModbusAnswers({.unit = 1}, EchoMode::on) { line.echoes = true; }
};
class ModbusEchoAuto : public ModbusAnswers {
protected:
    ModbusEchoAuto() : ModbusAnswers({.unit = 1}, EchoMode::automatic) {}
};

TEST_F(ModbusAnswers, AnAnswerThatIs1300MsLateIsNotTakenForAnotherRegister)
{
    line.answers("01 03 02 11 11", 1300ms);
    ASSERT_EQ(read(1), AccessError::no_answer);

    EXPECT_EQ(read(2), AccessError::deferred) << "its answer would look like the late one";
    EXPECT_EQ(line.asked.size(), 1u);

    line.time += 700ms;
    line.answers("01 03 02 22 22");
    EXPECT_EQ(read(2), AccessError::none) << "the late one has come";
    EXPECT_EQ(words[0], 0x2222);
}

TEST_F(ModbusAnswers, TheAnswerToARequestThatLeftInACallThatStalledIsNotTakenForAnotherRegister)
{
    line.answers("01 03 02 04 57", 40ms);
    line.stalls = true;
    EXPECT_EQ(read(1000), AccessError::no_answer);
    line.stalls = false;

    EXPECT_EQ(read(2000), AccessError::deferred) << "the other answer is still owed";

    line.time += 100ms;
    client->listen();
    line.answers("01 03 02 08 AE");
    EXPECT_EQ(read(2000), AccessError::none);
    EXPECT_EQ(words[0], 0x08AE);
}

TEST_F(ModbusAnswers, ALateAnswerThatIsHeardEndsTheDebt)
{
    line.answers("01 03 02 11 11", 800ms);
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.answers("01 03 04 00 01 00 02", 900ms);
    line.time += 1ms;
    ASSERT_EQ(read(10, 2, 2), AccessError::no_answer) << "another unit is asked meanwhile";
    line.answers("01 03 02 22 22");

    EXPECT_EQ(read(2), AccessError::none);
    EXPECT_EQ(words[0], 0x2222);
    EXPECT_EQ(client->counts({.unit = 1}).late, 1u);
}

TEST_F(ModbusAnswers, ABlockOfAnotherLengthIsAskedAndItsAnswerEndsTheDebt)
{
    line.answers("01 03 04 00 01 00 02");
    ASSERT_EQ(read(10, 2), AccessError::none);
    line.is_silent();
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.answers("01 03 04 00 03 00 04"); // the block that clears
    line.answers("01 03 02 22 22");

    EXPECT_EQ(read(2), AccessError::none);
    EXPECT_EQ(words[0], 0x2222);
    EXPECT_THAT(line.asked, ElementsAre("01 03 00 0A 00 02", "01 03 00 01 00 01", "01 03 00 0A 00 02",
                                        "01 03 00 02 00 01"));
}

TEST_F(ModbusAnswers, ABlockThatNeverGaveDataIsNotAskedWhileItsFunctionIsOwed)
{
    line.is_silent();
    ASSERT_EQ(read(1), AccessError::no_answer);

    EXPECT_EQ(read(10, 2), AccessError::deferred) << "an exception would not show which of the two is denied";
    EXPECT_EQ(line.asked.size(), 1u);
}

TEST_F(ModbusAnswersOf2400, FunctionFourStandsInForFunction3)
{
    line.answers("01 03 02 00 07");
    ASSERT_EQ(read(2), AccessError::none);
    line.answers("01 03 02 11 11", 1300ms);
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.answers({{"01 03 02 11 11", 5ms}, {"01 04 02 22 22", 10ms}});

    EXPECT_EQ(read(2), AccessError::none);
    EXPECT_EQ(words[0], 0x2222);
    EXPECT_EQ(line.asked.back(), "01 04 00 02 00 01");
}

TEST_F(ModbusAnswersWithLoopback, ATokenThatComesBackEndsEveryDebt)
{
    line.is_silent();
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.answers("01 08 00 00 00 01");
    line.answers("01 03 02 22 22");

    EXPECT_EQ(read(2), AccessError::none);
    EXPECT_THAT(line.asked, ElementsAre("01 03 00 01 00 01", "01 08 00 00 00 01", "01 03 00 02 00 01"));
}

TEST_F(ModbusAnswersWithLoopback, IsGivenUpAfterThreeSilences)
{
    for (int i = 0; i < 6; ++i) EXPECT_NE(read(1), AccessError::none);

    EXPECT_THAT(line.asked, ElementsAre("01 03 00 01 00 01", "01 08 00 00 00 01", "01 08 00 00 00 02",
                                        "01 08 00 00 00 03"));
}

TEST_F(ModbusAnswers, SettlesTenTimeOutsAfterTheRequest)
{
    line.is_silent();
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.time = Instant{} + 6s;
    EXPECT_EQ(read(2), AccessError::deferred) << "the wire time of what is owed comes on top";
    line.time = Instant{} + 6050ms;
    line.answers("01 03 02 22 22");

    EXPECT_EQ(read(2), AccessError::none);
}

TEST_F(ModbusAnswers, AnExceptionOfAnotherTagSetsNoInput)
{
    line.answers("01 03 04 00 01 00 02");
    ASSERT_EQ(read(10, 2), AccessError::none);
    line.answers("01 83 02", 900ms); // register 1 is denied, late
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.answers("01 03 04 00 03 00 04", 400ms);

    EXPECT_EQ(read(10, 2), AccessError::none) << "the exception before it belongs to register 1";
    EXPECT_THAT(words, ElementsAre(3, 4));
}

TEST_F(ModbusAnswers, AWrongCheckSumBeforeTheAnswerShiftsNothing)
{
    line.answers({{"", 5ms}, {"01 03 02 11 11", 10ms}});
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.time += 20ms;
    line.answers("01 03 02 22 22");

    EXPECT_EQ(read(2), AccessError::none) << "the answer to the first has come meanwhile";
    EXPECT_EQ(words[0], 0x2222);
    EXPECT_EQ(client->counts({.unit = 1}).damaged, 1u);
}

TEST_F(ModbusAnswersWithLoopback, AWriteIsNotAskedWhileOneIsOwed)
{
    line.answers("01 06 00 01 00 05", 900ms);
    ASSERT_EQ(write(1, 5), AccessError::no_answer);
    line.answers("01 08 00 00 00 01", 400ms);
    line.answers("01 06 00 01 00 06");

    EXPECT_EQ(write(1, 6), AccessError::none);
    EXPECT_THAT(line.asked, ElementsAre("01 06 00 01 00 05", "01 08 00 00 00 01", "01 06 00 01 00 06"));
}

TEST_F(ModbusAnswers, SaysOfAWriteWhetherItWasSent)
{
    line.is_silent();
    EXPECT_EQ(write(1, 5), AccessError::no_answer);
    EXPECT_TRUE(client->has_sent());
    EXPECT_EQ(write(1, 5), AccessError::deferred) << "an answer of this form is owed";
    EXPECT_FALSE(client->has_sent());
    EXPECT_EQ(line.asked.size(), 1u);
}

TEST_F(ModbusAnswers, AUnitIsBackOnAnyFrameOfItsOwn)
{
    line.answers("01 03 02 11 11", 700ms);
    ASSERT_EQ(read(5), AccessError::no_answer);
    line.is_silent();

    EXPECT_EQ(client->probe({.unit = 1}), AccessError::none) << "a late one is one";
    EXPECT_NE(client->probe({.unit = 1}), AccessError::none);
}

TEST_F(ModbusEcho, IsNotTakenForTheAnswerToAWrite)
{
    EXPECT_EQ(write(1, 5), AccessError::no_answer) << "only the echo came";
    line.time += 10s;
    line.answers("01 06 00 01 00 05");
    EXPECT_EQ(write(1, 5), AccessError::none) << "the second copy is the answer";
    line.answers("01 03 02 22 22");
    EXPECT_EQ(read(2), AccessError::none);
    EXPECT_NE(client->probe({.unit = 1}), AccessError::none) << "an echo is no sign of life";
}

TEST_F(ModbusAnswers, ARequestThatComesBackThoughThereIsNoEchoIsCounted)
{
    line.echoes = true;
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(read(1), AccessError::no_answer);
        line.time += 10s; // nothing is owed any more
    }
    EXPECT_EQ(client->counts({.unit = 1}).came_back, 3U);
}

TEST_F(ModbusEchoAuto, IsFoundOutByReadsBeforeAnythingIsAskedThatLooksLikeItsAnswer)
{
    EXPECT_EQ(write(1, 5), AccessError::deferred);
    EXPECT_THAT(line.asked, IsEmpty());
    line.answers("01 03 02 00 05");
    ASSERT_EQ(read(1), AccessError::none);
    line.answers("01 06 00 01 00 05");
    EXPECT_EQ(write(1, 5), AccessError::none);
}

TEST_F(ModbusEchoAuto, HeardOnceIsExpectedFromThenOn)
{
    line.echoes = true;
    line.answers("01 03 02 00 05");
    ASSERT_EQ(read(1), AccessError::none);
    EXPECT_EQ(write(1, 5), AccessError::no_answer);
}

} // namespace
} // namespace dpslave::modbus
