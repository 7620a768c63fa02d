// SPDX-License-Identifier: Apache-2.0
/// A TOML file read key by key: the reader of a key says what is legal, and what is not becomes a
/// fault with its place. Keys that were never read are faults too, so there is no second list of legal keys
/// to keep up.
#pragma once

#include "dpslave/input/fault.hpp"
#include "dpslave/input/text_source.hpp"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::input {

struct Place {
    unsigned line = 0;   ///< from 1; 0 = the file as a whole
    unsigned column = 0; ///< from 1
};

class Document;
struct Node; // a table of the file; only document.cpp knows what is in it

/// One table of a Document: a view, valid as long as the Document. Questions to a table that is not in the
/// file find nothing. A value of the wrong type or outside the legal ones is a fault and then counts as not
/// there.
class Table {
public:
    bool exists() const { return node_ != nullptr; }
    Place place() const;
    /// Returns the place of the key's value, or of the table if there is none.
    Place place_of(std::string_view key) const;
    std::vector<std::string> keys() const;
    bool has(std::string_view key) const;
    /// The value is a text (for a key that may be a text or a number).
    bool is_text(std::string_view key) const;

    /// A fault if the key is missing; `example` is the line to add.
    void require(std::string_view key, std::string_view example);

    std::optional<std::string> text(std::string_view key);  ///< not empty, no control characters
    std::optional<std::string> lines(std::string_view key); ///< a text with ends of lines; not empty
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t min, std::int64_t max);
    std::optional<double> real(std::string_view key, double min, double max);
    std::optional<bool> boolean(std::string_view key);
    std::optional<std::vector<std::string>> texts(std::string_view key, std::size_t least = 1);
    std::optional<std::vector<std::int64_t>> integers(std::string_view key, std::int64_t min,
                                                      std::int64_t max);

    /// One of a closed set of texts, as the value that belongs to it.
    template <class T>
    std::optional<T> choice(std::string_view key, std::initializer_list<std::pair<std::string_view, T>> legal)
    {
        std::vector<std::string> names;
        for (const auto& [name, value] : legal) names.emplace_back(name);
        const auto index = index_of(key, names);
        if (!index) return std::nullopt;
        return (legal.begin() + *index)->second;
    }

    Table table(std::string_view key);               ///< [key]
    std::vector<Table> tables(std::string_view key); ///< [[key]]

    /// A fault at the key's value: what is wrong with it, and what to do.
    void refuse(std::string_view key, std::string what);

private:
    friend class Document;
    Table(Document* document, Node* node) : document_(document), node_(node) {}
    std::optional<std::ptrdiff_t> index_of(std::string_view key, std::span<const std::string> legal);

    Document* document_ = nullptr;
    Node* node_ = nullptr;
};

class Document {
public:
    /// Reads `name`. If it cannot be read or is no TOML, that is a fault, and root() is an empty table.
    Document(const TextSource& source, std::string name);
    ~Document();
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    bool readable() const { return readable_; }
    const std::string& name() const { return name_; }
    Table root();

    void fault(Place place, std::string what);
    /// Returns every fault in the order of the file, those of unknown keys included. Call it after all
    /// questions.
    Faults faults() const;

private:
    std::string name_;
    bool readable_ = false;
    std::unique_ptr<Node> root_;
    Faults faults_;
};

} // namespace dpslave::input
