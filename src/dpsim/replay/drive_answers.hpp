// SPDX-License-Identifier: Apache-2.0
/// The drive side of a capture: answers the gateway's requests with what the drives answered. It is pure.
#pragma once

#include "replay_script.hpp"

#include <map>

namespace dpslave::sim {

class DriveAnswers {
public:
    explicit DriveAnswers(const ReplayScript& script);

    /// Takes octets of the gateway. `at` is the place in the capture: the answer is the newest until then,
    /// before the first one that one. A write is answered as one of this parameter was, whatever its value.
    /// It returns nullopt if the request is not complete yet, or the capture has none like it.
    std::optional<Octets> on_bytes(Bytes octets, std::chrono::nanoseconds at);
    /// Requests that the capture has no answer to, each once.
    std::vector<Octets> take_unknown() { return std::exchange(unknown_, {}); }
    /// The line was silent: what is not complete is given up.
    void forget() { rx_.clear(); }

private:
    struct Answer {
        std::chrono::nanoseconds at{};
        Octets request{}, octets{};
    };

    std::optional<Octets> answer_to(const Octets& request, std::chrono::nanoseconds at);

    bool is_modbus_;
    std::map<Octets, std::vector<Answer>> answers_; ///< by what a request asks for, in the order of the file
    Octets rx_;
    std::map<Octets, bool> reported_;
    std::vector<Octets> unknown_;
};

} // namespace dpslave::sim
