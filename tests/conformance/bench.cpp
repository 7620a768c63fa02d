// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

namespace conformance {
namespace {

/// Longer than a slave may take from Chk_Cfg until it is ready (wire reference 6.4, row C2: 1 s).
constexpr int kMostPolls =
    2000; // a drive that is not there is waited for; a busy machine needs longer for it
constexpr std::chrono::milliseconds kPollPause{5};

testing::AssertionResult is(const std::string& got, const char* wanted, const char* what)
{
    if (got == wanted) return testing::AssertionSuccess();
    return testing::AssertionFailure() << what << ": " << got << " instead of " << wanted;
}

} // namespace

Octets Bench::prm(const PrmHeader& header, const Octets& user) const
{
    Octets all{header.status,
               header.factor_1,
               header.factor_2,
               header.min_tsdr,
               static_cast<std::uint8_t>(family.ident / 256),
               static_cast<std::uint8_t>(family.ident % 256),
               header.group};
    all.insert(all.end(), user.begin(), user.end());
    return all;
}

testing::AssertionResult Bench::parameterise(const PrmHeader& header)
{
    if (auto wrong = is(owner.set_prm(prm(header)), "SC", "Set_Prm"); !wrong) return wrong;
    return is(diag(), (header.status & 0x08) != 0 ? kWaitCfg : "02 04 00 02", "diagnosis after Set_Prm");
}

testing::AssertionResult Bench::start_up(const PrmHeader& header)
{
    return start_up(header, family.user_prm, cfg());
}

testing::AssertionResult Bench::start_up(const PrmHeader& header, const Octets& user, const Octets& cfg)
{
    if (auto wrong = is(owner.set_prm(prm(header, user)), "SC", "Set_Prm"); !wrong) return wrong;
    if (auto wrong = is(owner.chk_cfg(cfg), "SC", "Chk_Cfg"); !wrong) return wrong;
    if (auto wrong = becomes_ready(); !wrong) return wrong;
    return is(diag(), (header.status & 0x08) != 0 ? kExchanging : kExchangingUnguarded,
              "diagnosis after Chk_Cfg");
}

testing::AssertionResult Bench::becomes_ready()
{
    for (int polls = 0; polls < kMostPolls; ++polls) {
        const std::string now = diag(owner);
        if (now.size() == 11 && test::octets(now)[0] % 4 == 0 && (test::octets(now)[1] & 0x02) == 0) {
            owner.slave_diag(); // the end of Stat_Diag is pending itself
            return testing::AssertionSuccess();
        }
        slave.pass(kPollPause);
    }
    return testing::AssertionFailure() << "Stat_Diag does not end: " << diag();
}

testing::AssertionResult Bench::exchange(const Octets& outputs, const PrmHeader& header)
{
    if (auto wrong = start_up(header); !wrong) return wrong;
    return is(owner.data_exchange(outputs), inputs_at_start().c_str(), "Data_Exchange");
}

void Bench::shorten_the_watchdog()
{
    EXPECT_EQ(owner.set_prm(prm({.factor_1 = 10, .factor_2 = 1})), "SC");
}

void Bench::let_the_watchdog_expire()
{
    shorten_the_watchdog();
    slave.pass(std::chrono::milliseconds{200});
}

std::string Bench::diag(Master& who)
{
    const std::string reply = who.slave_diag();
    return reply.starts_with("DL ") ? reply.substr(3, 11) : reply;
}

Octets words(const std::vector<std::uint16_t>& all)
{
    Octets octets;
    for (const std::uint16_t word : all) {
        octets.push_back(static_cast<std::uint8_t>(word / 256));
        octets.push_back(static_cast<std::uint8_t>(word % 256));
    }
    return octets;
}

std::string dl(const std::vector<std::uint16_t>& all)
{
    return "DL " + test::show(words(all));
}

std::string dh(const std::vector<std::uint16_t>& all)
{
    return "DH " + test::show(words(all));
}

std::string inputs_at_start()
{
    return dl({kInputsAtStart.begin(), kInputsAtStart.end()});
}

} // namespace conformance
