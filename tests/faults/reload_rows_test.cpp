// SPDX-License-Identifier: Apache-2.0
// A configuration with a fault in it.
// Only here: a file that is wrong beside a running exchange.
#include "fault_row.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

class RowOfAReload : public FaultRow {};

TEST_F(RowOfAReload, F27_WithAFaultInTheFileIsRefusedAndTheOldConfigurationGoesOn)
{
    begins();
    const std::string good = gateway->config_text();
    write_file(gateway->config(), good + "adress = 7\n");
    const Outcome outcome = gateway->dpctl({"reload"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("adress"));
    EXPECT_THAT(outcome.err, HasSubstr("the old one stays in use"));
    EXPECT_TRUE(gateway->daemon().says("the new configuration is refused"));
    for (int value = 2; value <= 5; ++value) {
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        drive_shows(value);
        EXPECT_TRUE(master_sees(value));
    }
    EXPECT_TRUE(master_stays_in_data_exchange());

    write_file(gateway->config(), good);
    fault_ends();
    EXPECT_EQ(gateway->dpctl({"reload"}).status, 0);
    recovered();
    EXPECT_TRUE(master_stays_in_data_exchange());
    EXPECT_TRUE(never_an_older_one(taken()));
}

} // namespace
} // namespace dpslave::test
