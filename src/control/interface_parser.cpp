// SPDX-License-Identifier: Apache-2.0
// Reads the interface definition language of varlink.org by recursive descent, one function per rule.
#include "interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace dpslave::control {
namespace {

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<Interface, std::string> interface()
    {
        Interface result;
        bool good = keyword("interface") && word(result.name, true);
        while (good && !at_end()) good = member(result);
        if (!good) return Failure{fmt::format("line {}: {}", line(), why_)};
        return result;
    }

private:
    static constexpr int kMaxNesting = 16;

    void skip_space()
    {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#')
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (std::isspace(static_cast<unsigned char>(c)) != 0)
                ++at_;
            else
                return;
        }
    }
    bool at_end()
    {
        skip_space();
        return at_ == text_.size();
    }
    bool fail(std::string why)
    {
        if (why_.empty()) why_ = std::move(why);
        return false;
    }
    std::ptrdiff_t line() const
    {
        return 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    }

    /// Takes `mark` when it comes next.
    bool taken(std::string_view mark)
    {
        skip_space();
        if (text_.substr(at_, mark.size()) != mark) return false;
        at_ += mark.size();
        return true;
    }
    bool expect(std::string_view mark) { return taken(mark) || fail(fmt::format("'{}' expected", mark)); }

    bool word(std::string& out, bool with_dots = false)
    {
        skip_space();
        const std::size_t start = at_;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' &&
                !(with_dots && (c == '.' || c == '-')))
                break;
            ++at_;
        }
        out = text_.substr(start, at_ - start);
        return !out.empty() || fail("a name expected");
    }
    bool keyword(std::string_view wanted)
    {
        std::string got;
        return (word(got) && got == wanted) || fail(fmt::format("'{}' expected", wanted));
    }

    /// type NAME (...) | method NAME (...) -> (...) | error NAME (...)
    bool member(Interface& to)
    {
        std::string kind, name;
        if (!word(kind) || !word(name)) return false;
        if (kind == "type") {
            Type t;
            return parenthesis(t, 0) &&
                   (to.types.emplace(name, std::move(t)).second || fail("a second type " + name));
        }
        Type in;
        if (!parenthesis(in, 0) || !structure_only(in)) return false;
        if (kind == "error")
            return to.errors.emplace(name, std::move(in.fields)).second || fail("a second error " + name);
        if (kind != "method") return fail("'type', 'method' or 'error' expected");
        Type out;
        if (!expect("->") || !parenthesis(out, 0) || !structure_only(out)) return false;
        MethodType method{std::move(in.fields), std::move(out.fields)};
        return to.methods.emplace(name, std::move(method)).second || fail("a second method " + name);
    }
    bool structure_only(const Type& t)
    {
        return t.kind == Type::Kind::structure || fail("fields with types expected");
    }

    /// (a: T, b: U) is a structure, (a, b) an enumeration, () an empty structure.
    bool parenthesis(Type& out, int depth)
    {
        if (depth > kMaxNesting) return fail("nested too deep");
        if (!expect("(")) return false;
        out.kind = Type::Kind::structure;
        if (taken(")")) return true;
        bool first = true;
        do {
            std::string name;
            if (!word(name)) return false;
            const bool typed = taken(":");
            if (first) out.kind = typed ? Type::Kind::structure : Type::Kind::enumeration;
            if (typed != (out.kind == Type::Kind::structure))
                return fail("a structure and an enumeration in one");
            if (typed) {
                Field field{std::move(name), {}};
                if (!type(field.type, depth + 1)) return false;
                out.fields.push_back(std::move(field));
            } else {
                out.words.push_back(std::move(name));
            }
            first = false;
        } while (taken(","));
        return expect(")");
    }

    bool type(Type& out, int depth)
    {
        if (depth > kMaxNesting) return fail("nested too deep");
        out.nullable = taken("?");
        const bool array = taken("[]");
        if (array || taken("[string]")) {
            Type inner;
            if (!type(inner, depth + 1)) return false;
            out.kind = array ? Type::Kind::array : Type::Kind::map;
            out.inner = std::make_shared<const Type>(std::move(inner));
            return true;
        }
        skip_space();
        if (at_ < text_.size() && text_[at_] == '(') return parenthesis(out, depth);
        if (!word(out.name)) return false;
        out.kind = out.name == "bool"     ? Type::Kind::boolean
                   : out.name == "int"    ? Type::Kind::integer
                   : out.name == "float"  ? Type::Kind::number
                   : out.name == "string" ? Type::Kind::string
                   : out.name == "object" ? Type::Kind::object
                                          : Type::Kind::named;
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::string why_;
};

} // namespace

Result<Interface, std::string> parse_interface(std::string_view text)
{
    return Parser{text}.interface();
}

} // namespace dpslave::control
