// SPDX-License-Identifier: Apache-2.0
/// A value, or the named reason why there is none. The shape of std::expected (C++23).
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace dpslave {

/// The reason, on its way into a Result: `return Failure{Flaw::checksum};`
template <class E>
struct Failure {
    E why;
};
template <class E>
Failure(E) -> Failure<E>;

template <class T, class E>
class [[nodiscard]] Result {
    static_assert(!std::is_same_v<T, E>, "value and reason must differ in type");

public:
    constexpr Result(T value) : held_(std::in_place_index<0>, std::move(value)) {}
    constexpr Result(Failure<E> failure) : held_(std::in_place_index<1>, std::move(failure.why)) {}

    constexpr explicit operator bool() const noexcept { return held_.index() == 0; }
    constexpr const T& operator*() const& noexcept { return *std::get_if<0>(&held_); }
    constexpr T&& operator*() && noexcept { return std::move(*std::get_if<0>(&held_)); }
    constexpr T& operator*() & noexcept { return *std::get_if<0>(&held_); }
    constexpr const T* operator->() const noexcept { return std::get_if<0>(&held_); }
    constexpr T* operator->() noexcept { return std::get_if<0>(&held_); }
    constexpr const E& error() const noexcept { return *std::get_if<1>(&held_); }

private:
    std::variant<T, E> held_;
};

} // namespace dpslave
