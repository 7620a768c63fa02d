// SPDX-License-Identifier: Apache-2.0
/// The parameters of one drive that a layout and the watched tags need: one record for each tag, ascending.
/// If several outputs of a layout have the same tag, each further one has a record after it, which is not
/// read.
#pragma once

#include "parameter.hpp"

#include <vector>

namespace dpslave::drive {

class ParameterSet {
public:
    ParameterSet() = default;
    /// One record for each use of a tag, in any order; a tag with the same row in two of them has one record.
    explicit ParameterSet(std::vector<DriveParameter> uses);
    ParameterSet(const ParameterSet&) = delete; // plans point to the records
    ParameterSet& operator=(const ParameterSet&) = delete;
    ParameterSet(ParameterSet&&) = default;
    ParameterSet& operator=(ParameterSet&&) = default;

    std::vector<DriveParameter>& all() { return records_; }
    const std::vector<DriveParameter>& all() const { return records_; }
    /// The record of a tag that is read; nullptr: it is not.
    DriveParameter* find_read(std::uint16_t tag);
    const DriveParameter* find_read(std::uint16_t tag) const;
    const DriveParameter* find_output(std::size_t parameter) const;

    bool every_input_tried() const; ///< and each output whose form is asked for
    /// One of those has answered with a number of unknown scale.
    bool scale_missing() const;
    /// Says how many of the tags of the layout the drive denies.
    enum class Denied : std::uint8_t { none, some, all };
    Denied denied() const;

    /// The readings are lost with the drive. `is_result`: each counts as tried by that; else each is to be
    /// read again, but for those that the drive does not have.
    void readings_lost(bool is_result);
    void writings_lost();

    /// The rows are other ones for the same layout: what is known stays where the drive is asked the same;
    /// else the input is held until it has been read anew, and the output is written anew.
    void take_over(const ParameterSet& before);

private:
    std::vector<DriveParameter> records_;
};

/// Both ask the drive the same, and make the same word of its answer.
bool is_read_alike(const DriveParameter& a, const DriveParameter& b);
bool is_written_alike(const DriveParameter& a, const DriveParameter& b);

} // namespace dpslave::drive
