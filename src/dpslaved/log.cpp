// SPDX-License-Identifier: Apache-2.0
#include "log.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/io/realtime.hpp"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace dpslave {
namespace {

/// systemd says which stream it has connected to the journal; a variable that was inherited does not count.
bool stderr_is_journal()
{
    const char* stream = std::getenv("JOURNAL_STREAM");
    struct stat there {};
    if (stream == nullptr || ::fstat(STDERR_FILENO, &there) != 0) return false;
    return fmt::format("{}:{}", there.st_dev, there.st_ino) == stream;
}

/// "<4>": the level as the journal reads it at the beginning of a line (sd-daemon(3)).
class JournalLevel final : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        using Level = spdlog::level::level_enum;
        const char digit = message.level >= Level::critical ? '2'
                           : message.level == Level::err    ? '3'
                           : message.level == Level::warn   ? '4'
                           : message.level == Level::info   ? '6'
                                                            : '7';
        for (const char character : {'<', digit, '>'}) out.push_back(character);
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JournalLevel>(); }
};

/// The message, in which no text of a file, a drive or a caller can forge a line or move a cursor.
class PrintableMessage final : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        const std::string text = printable({message.payload.data(), message.payload.size()});
        out.append(text.data(), text.data() + text.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override
    {
        return std::make_unique<PrintableMessage>();
    }
};

/// Lines for which there is no room are counted, and their number is said later.
class StandardError final : public spdlog::sinks::base_sink<std::mutex> {
public:
    explicit StandardError(std::shared_ptr<io::LogThread> thread) : thread_(std::move(thread)) {}

private:
    void sink_it_(const spdlog::details::log_msg& message) override
    {
        lost_ += thread_->take_lost();
        if (lost_ != 0) {
            const std::string text = fmt::format(
                "{} line(s) of the log were lost: what reads it had stopped, or a disk was full", lost_);
            if (say({message.logger_name, spdlog::level::warn, text})) lost_ = 0;
        }
        if (lost_ != 0 || !say(message)) ++lost_;
    }
    bool say(const spdlog::details::log_msg& message)
    {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        return thread_->put({line.data(), line.size()});
    }
    void flush_() override {} // the thread keeps nothing that it can write

    std::shared_ptr<io::LogThread> thread_;
    std::uint64_t lost_ = 0;
};

} // namespace

std::shared_ptr<io::LogThread> set_up_log()
{
    io::make_stacks_small(); // before the first thread
    auto thread = std::make_shared<io::LogThread>(STDERR_FILENO);
    auto log = std::make_shared<spdlog::logger>("dpslaved", std::make_shared<StandardError>(thread));
    auto format = std::make_unique<spdlog::pattern_formatter>();
    format->add_flag<JournalLevel>('*');
    format->add_flag<PrintableMessage>('~');
    format->set_pattern(stderr_is_journal() ? "%*%~" : "%Y-%m-%d %H:%M:%S.%e %l: %~");
    log->set_formatter(std::move(format));
    spdlog::set_default_logger(std::move(log));
    return thread;
}

} // namespace dpslave
