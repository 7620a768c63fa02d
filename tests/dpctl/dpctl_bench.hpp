// SPDX-License-Identifier: Apache-2.0
/// A daemon of fixtures in a thread of this process, and the real program dpctl in a process of its own.
#pragma once

#include "control/bench.hpp"

#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace dpslave::test {

/// Serves the fixtures. A trace of all ends with a drive line, while the bus has three octets of a telegram.
/// Stations "unwinder" and "rewinder"; tags are answered later, as a drive does: tag 1
/// is read only, tag 2 never gets an answer. FAULT of
/// TEC OPTION cannot be set. A survey of tags 1 to 5 and 9 finds 12.5, no such tag, silence, >1B0B, 30.
/// and 7.; tag 5 is Busy and then lost before it answers. Watch gives a first picture at once and a second
/// one, in which the unwinder has left Data_Exch, as soon as a client watches. FindTags knows 7 SPEED
/// FEEDBACK, 8 SPEED DEMAND and 9 TORQUE.
class FixtureDaemon {
public:
    /// `behind_each_text`: is added to each text of each reply.
    explicit FixtureDaemon(std::string behind_each_text = {});
    FixtureDaemon(const FixtureDaemon&) = delete;
    FixtureDaemon& operator=(const FixtureDaemon&) = delete;
    ~FixtureDaemon();

    std::string socket() const { return socket_.string(); }
    /// From now on this station is in `state` in the reply of GetStatus.
    void set_state(const std::string& station, const std::string& state);
    /// Waits until `method` was called. False: it was not for long.
    bool was_asked(const std::string& method);
    /// All who watch get a picture in which the value of tag 7 is 51.00.
    void change_value();
    /// All who follow the events get a new one: the drive of the unwinder does not answer.
    void something_happens();
    /// The tags of each ReadTag, in their order.
    std::vector<int> read() const
    {
        const std::lock_guard lock(mutex_);
        return read_;
    }
    /// Waits until ReadTag was called so often. False: it was not for long.
    bool was_read(std::size_t times);
    /// The parameters of the last WriteTag, SetTec or SetLogLevel.
    Json written() const
    {
        const std::lock_guard lock(mutex_);
        return written_;
    }

private:
    control::Methods methods();
    control::Reply tag(const Json& parameters, const control::Caller& caller);
    static control::Reply find_tags(const Json& parameters);
    void push_events();
    void push_line();
    Json reply(const std::string& method) const;
    control::Reply survey(const Json& parameters);

    std::string behind_each_text_;
    TempFolder folder_;
    std::filesystem::path socket_ = folder_.path() / "control.sock";
    std::vector<std::pair<control::ReplyTo, control::LastReply>> answers_;
    bool second_picture_due_ = false;
    control::ReplyTo trace_; ///< whose second reply is due
    std::vector<control::ReplyTo> watches_;
    std::map<int, int> surveyed_; ///< by tag, how often; only the thread's
    mutable std::mutex mutex_;
    std::condition_variable asked_;
    std::set<std::string> questions_;
    std::vector<int> read_;
    std::vector<control::ReplyTo> events_followed_; ///< only the thread's
    std::map<std::string, std::string> states_;     ///< by station
    Json written_;
    int stop_, wake_, event_;
    std::thread thread_;
};

/// What a dpctl printed and how it ended.
struct Ran {
    int exit = -1;
    std::string out, err;
    bool echoes =
        false; ///< its terminal, at the end: it echoes and gives whole lines, as it was at the start
};

/// A running dpctl.
class Dpctl {
public:
    enum class As { this_user, unprivileged };
    /// `terminal`: its output and input are a pty.
    Dpctl(std::vector<std::string> arguments, As user = As::this_user, bool terminal = false);
    Dpctl(const Dpctl&) = delete;
    Dpctl& operator=(const Dpctl&) = delete;
    ~Dpctl();

    /// Reads its output until `text` has come. False: it ended before, or nothing came for long.
    bool prints(const std::string& text);
    /// Reads until something further has come. False: it ended, or nothing came for long.
    bool prints_more() { return read_some(); }
    const std::string& printed() const { return ran_.out; } ///< until now
    void type(std::string_view keys);
    /// Its terminal has this size from now on; it gets the signal.
    void resize(unsigned short columns, unsigned short rows);
    /// Whether its terminal echoes and gives whole lines.
    bool echoes() const;
    void signal(int number);
    /// Waits until it has been stopped (SIGSTOP). False: it ended instead.
    bool stands_still();
    Ran wait();

private:
    bool read_some();
    int pid_ = -1;
    int out_ = -1, err_ = -1;
    Ran ran_;
};

/// Runs dpctl with `arguments` to its end.
Ran dpctl(std::vector<std::string> arguments, Dpctl::As user = Dpctl::As::this_user);

} // namespace dpslave::test
