// SPDX-License-Identifier: Apache-2.0
/// Varlink on the wire (varlink.org): JSON objects, each ended by one NUL. Pure: octets in, values out.
/// Whatever a caller sends is bounded in size and depth before the JSON parser sees it, and nothing is thrown
/// outwards.
#pragma once

#include "dpslave/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::control {

using Json = nlohmann::json;

/// The interface of the daemon.
inline constexpr std::string_view kInterface = "org.dpslaved.Control";

/// Longest call that is taken, in octets without its NUL. Every call of our interfaces fits 1 KiB.
inline constexpr std::size_t kMaxCall = 16 * 1024;
/// Longest reply that is sent or taken: 125 stations with 12 words each need some 300 KiB.
inline constexpr std::size_t kMaxReply = 1024 * 1024;
/// Deepest nesting of objects and arrays; our deepest reply has 6.
inline constexpr int kMaxDepth = 16;

/// Why a run of octets is no message. Counted by the server, which then ends the connection: after one of
/// these it is unknown where the next message starts and what the caller meant.
enum class Flaw : std::uint8_t {
    too_long,    ///< no NUL within the limit
    too_deep,    ///< nested deeper than kMaxDepth
    not_json,    ///< no JSON text: also an empty message and invalid UTF-8
    not_object,  ///< JSON, but no object
    no_method,   ///< a call without `method`
    bad_method,  ///< `method` is no string, or not "interface.Method"
    bad_members, ///< `parameters` no object, or a flag or `error` of the wrong type
    bad_flags,   ///< `oneway` together with `more`
};
std::string_view text(Flaw flaw) noexcept;

/// A method call as it came.
struct Call {
    std::string interface; ///< "org.dpslaved.Control"
    std::string method;    ///< "GetStatus"
    Json parameters;       ///< an object, empty when the caller sent none
    bool more = false;     ///< the caller takes several replies
    bool oneway = false;   ///< the caller takes no reply
    bool upgrade = false;  ///< the caller wants another protocol on this connection; there is none
};

/// A reply as it came.
struct ReplyMessage {
    Json parameters;        ///< an object, also of an error
    std::string error;      ///< qualified name; empty = no error
    bool continues = false; ///< more replies to the same call follow
};

/// The parameters of a reply, or an error with its name. A name without a dot belongs to
/// org.dpslaved.Control.
struct Done {
    Json parameters = Json::object();
};
struct Error {
    std::string name;
    Json parameters = Json::object();
};

/// Judges one message, without its NUL.
Result<Call, Flaw> parse_call(std::string_view message);
Result<ReplyMessage, Flaw> parse_reply(std::string_view message);

/// One message with its NUL. Text that is not UTF-8 is sent with replacement characters, never refused.
std::string encode_call(std::string_view method, const Json& parameters, bool more = false);
std::string encode_reply(const Done& reply, bool continues = false);
std::string encode_error(const Error& error);

/// Cuts a stream of octets into messages. Holds one unfinished message, at most `limit` octets of it, and the
/// octets behind the message given last.
class Framer {
public:
    explicit Framer(std::size_t limit) : limit_(limit) {}

    /// Precondition: the octets fit into what room() says.
    void feed(std::string_view octets);
    /// The next whole message without its NUL, valid until feed(); none = more octets are needed.
    Result<std::optional<std::string_view>, Flaw> next();
    /// How many octets may be fed now.
    std::size_t room() const noexcept { return limit_ + 1 - (buffer_.size() - taken_); }

private:
    std::string buffer_;
    std::size_t taken_ = 0;   ///< octets of buffer_ given out already
    std::size_t scanned_ = 0; ///< octets behind taken_ known to hold no NUL
    std::size_t limit_;
};

} // namespace dpslave::control
