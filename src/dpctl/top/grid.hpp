// SPDX-License-Identifier: Apache-2.0
/// A table in which each row is one line of the terminal, whatever it has to be cut for that. Pure.
#pragma once

#include "dpctl/cli/table.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dpslave::dpctl {

class Grid {
public:
    /// A name that begins with '>' heads a column that is set to the right and never cut. The most important
    /// columns stand first: what finds no room is left out from the end.
    explicit Grid(std::vector<std::string> header);
    void add(std::vector<Cell> row);
    std::size_t rows() const { return rows_.size(); }
    /// The header and the rows from `first`, `count` of them at most. Each line has `columns` columns at
    /// most.
    std::vector<std::string> lines(Look look, std::size_t columns, std::size_t first,
                                   std::size_t count) const;

private:
    std::vector<std::size_t> widths(std::size_t columns) const;
    std::string line(const std::vector<Cell>& row, const std::vector<std::size_t>& widths, Look look) const;

    std::vector<Cell> header_;
    std::vector<bool> right_;
    std::vector<std::vector<Cell>> rows_;
};

} // namespace dpslave::dpctl
