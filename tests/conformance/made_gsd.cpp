// SPDX-License-Identifier: Apache-2.0
#include "made_gsd.hpp"

#include "support/paths.hpp"

#include "dpslave/gsd/document.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/profile/profile.hpp"

#include <stdexcept>

namespace conformance {

namespace profile = dpslave::profile;
using dpslave::io::read_regular_file;
using dpslave::test::second_hand;

namespace {

std::string content_of(const std::string& file)
{
    const auto content = read_regular_file(file);
    if (!content) throw std::runtime_error{file + " cannot be read"};
    return *content;
}

} // namespace

dpslave::test::SecondHand gsd_of(const Family& family)
{
    const std::string source = dpslave::test::source_path();
    const auto known = profile::load_profile(read_regular_file, source + "/config/profiles", family.profile);
    if (!known) throw std::runtime_error{dpslave::input::to_string(known.error().at(0))};
    if (!known->gsd.file.empty())
        return second_hand(content_of(source + "/gsd/" + family.profile + '/' + known->gsd.file));
    profile::Selection selection;
    selection.ident = family.ident;
    const auto device = profile::device_of(*known, selection);
    if (!device) throw std::runtime_error{device.error().at(0)};
    return second_hand(dpslave::gsd::write(device->device));
}

} // namespace conformance
