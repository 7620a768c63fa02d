// SPDX-License-Identifier: Apache-2.0
/// Ten thousand random and mutated telegrams in a row. The bus is the judge: it fails the test when anything
/// is answered that is no valid request by the second hand, or is answered with what is no telegram.
#include "bench.hpp"
#include "golden.hpp"

#include <random>

using namespace dpslave;
using namespace test;

namespace {

class RandomTelegrams : public FdlStation {
protected:
    std::uint8_t octet() { return static_cast<std::uint8_t>(random() & 0xFF); }
    std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random() % bound); }

    Octets noise()
    {
        Octets out(1 + below(300));
        for (std::uint8_t& o : out) o = octet();
        return out;
    }
    /// Right in form, with any contents: any addresses, FC and data.
    Octets well_formed()
    {
        Octets data(1 + below(246));
        for (std::uint8_t& o : data) o = octet();
        const auto da = (random() % 2) == 0 ? kUs : octet();
        switch (below(3)) {
            case 0: return sd1(da, octet(), octet());
            case 1: return sd2(da, octet(), octet(), data);
            default: return sd2((random() % 2) == 0 ? 0x85 : da, octet(), octet(), data);
        }
    }
    Octets golden() { return octets(kGolden[below(kGolden.size())].octets); }
    Octets mutated(Octets out)
    {
        for (std::size_t changes = 1 + below(4); changes > 0 && !out.empty(); --changes) {
            const auto at = out.begin() + static_cast<std::ptrdiff_t>(below(out.size()));
            switch (below(4)) {
                case 0: *at = octet(); break;
                case 1: *at = static_cast<std::uint8_t>(*at ^ (1u << below(8))); break;
                case 2: out.erase(at); break;
                default: out.insert(at, octet()); break;
            }
        }
        return out;
    }

    std::mt19937 random{20'261}; // fixed: a failure can be repeated
};

TEST_F(RandomTelegrams, NothingInvalidIsAnsweredAndServiceIsNormalRightAfter)
{
    std::size_t replies = 0;
    for (int i = 0; i < 10'000 && !HasFailure(); ++i) {
        Octets octets;
        switch (below(6)) {
            case 0: octets = noise(); break;
            case 1: octets = well_formed(); break;
            case 2: octets = mutated(well_formed()); break;
            case 3: octets = golden(); break;
            default: octets = mutated(golden()); break;
        }
        user.answer = static_cast<fdl::Answer>(below(6));
        user.inputs.resize(below(245));
        if ((random() % 8) == 0)
            bus.arrives_in_one_read({octets, mutated(golden())});
        else if (octets.empty())
            continue;
        else if ((random() % 8) == 0)
            bus.arrives_octet_by_octet(octets);
        else
            bus.master_sends(octets);
        replies += bus.reply() ? 1u : 0u;
    }

    EXPECT_GT(replies, 500u);  // the good ones among them are answered,
    EXPECT_LT(replies, 5000u); // and by far not everything is
    bus.line_is_idle_for(bus.bits(33) + std::chrono::milliseconds{5});
    user.answer = fdl::Answer::low;
    user.inputs = {0x12, 0x34};
    bus.master_sends(octets("68 05 05 68 05 02 6D 00 00 74 16"));
    EXPECT_EQ(bus.reply(), octets("68 05 05 68 02 05 08 12 34 55 16"));
}

TEST_F(RandomTelegrams, EveryGoodRequestIsAnsweredInTheMiddleOfNoiseThatEndsWithSilence)
{
    for (int i = 0; i < 2'000 && !HasFailure(); ++i) {
        bus.arrives_in_one_read({noise(), mutated(golden())});
        bus.line_is_idle_for(bus.bits(33) + std::chrono::milliseconds{5});
        bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
        EXPECT_EQ(bus.reply(), octets("10 02 05 00 07 16")) << i;
    }
}

} // namespace
