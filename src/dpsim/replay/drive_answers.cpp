// SPDX-License-Identifier: Apache-2.0
#include "drive_answers.hpp"

#include "dpsim/drive/ei_ascii.hpp"
#include "dpsim/instrument/modbus_frame.hpp"

#include <algorithm>

namespace dpslave::sim {
namespace {

constexpr std::size_t kMostOfARequest = 512;
constexpr std::size_t kEiAddress = 5, kEiMnemonic = 2; ///< EOT, group twice, unit twice

/// Octets of the request of EI-ASCII that begins with `head` (an EOT). 0: it is not complete.
std::size_t ei_length(const Octets& head)
{
    if (head.size() <= kEiAddress) return 0;
    const bool is_write = head[kEiAddress] == kStx;
    const auto last = std::find(head.begin() + kEiAddress, head.end(), is_write ? kEtx : kEnq);
    if (last == head.end()) return 0;
    const auto length =
        static_cast<std::size_t>(last - head.begin()) + (is_write ? 2 : 1); // a BCC follows ETX
    return length <= head.size() ? length : 0;
}

/// Returns what a request asks for: a read as it is, a write without its value.
Octets asked_for(const Octets& request, bool is_modbus)
{
    std::size_t length = request.size();
    if (is_modbus) {
        const std::uint8_t code = request.size() > 1 ? request[1] : 0;
        length = code == kWriteOne ? 4 : code == kWriteBlock ? 6 : length;
    } else if (request.size() > kEiAddress && request[kEiAddress] == kStx) {
        length = kEiAddress + 1 + kEiMnemonic;
    }
    return Octets(request.begin(),
                  request.begin() + static_cast<std::ptrdiff_t>(std::min(length, request.size())));
}

} // namespace

DriveAnswers::DriveAnswers(const ReplayScript& script) : is_modbus_(script.is_modbus)
{
    const DriveFrame* request = nullptr;
    for (const DriveFrame& frame : script.drive) {
        if (frame.to_drive) {
            request = &frame;
        } else if (request != nullptr) {
            answers_[asked_for(request->octets, is_modbus_)].push_back(
                {.at = frame.at, .request = request->octets, .octets = frame.octets});
            request = nullptr;
        }
    }
}

std::optional<Octets> DriveAnswers::on_bytes(Bytes octets, std::chrono::nanoseconds at)
{
    rx_.insert(rx_.end(), octets.begin(), octets.end());
    if (rx_.size() > kMostOfARequest) rx_.clear();
    if (!is_modbus_) // the newest EOT begins anew, unless it is the check octet of a write
        for (std::size_t i = rx_.size(); i-- > 1;)
            if (rx_[i] == kEot && rx_[i - 1] != kEtx) {
                rx_.erase(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(i));
                break;
            }
    const std::size_t length = is_modbus_ ? request_length(rx_).value_or(0) : ei_length(rx_);
    if (length == 0 || rx_.size() < length) return std::nullopt;
    const Octets request(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(length));
    rx_.clear();
    return answer_to(request, at);
}

std::optional<Octets> DriveAnswers::answer_to(const Octets& request, std::chrono::nanoseconds at)
{
    const Octets key = asked_for(request, is_modbus_);
    const auto found = answers_.find(key);
    if (found == answers_.end()) {
        if (!std::exchange(reported_[key], true)) unknown_.push_back(request);
        return std::nullopt;
    }
    const std::vector<Answer>& all = found->second;
    auto newest = std::find_if(all.rbegin(), all.rend(), [at](const Answer& one) { return one.at <= at; });
    const Answer& answer = newest == all.rend() ? all.front() : *newest;
    // A request with function 6 is accepted by its echo.
    return answer.octets == answer.request ? request : answer.octets;
}

} // namespace dpslave::sim
