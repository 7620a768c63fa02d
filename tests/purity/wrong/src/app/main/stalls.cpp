// SPDX-License-Identifier: Apache-2.0
// tests/purity: three calls that may block and that no row names; what only looks like one is not found.
#include <thread>

std::mutex named;
void stall(const std::string& path)
{
    std::this_thread::sleep_for(1s);
    if (::write(1, "x", 1) < 0) return; // not ::open(
    plant.open(config::canonical(path));
    Plant::open(path);
}
