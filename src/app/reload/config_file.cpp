// SPDX-License-Identifier: Apache-2.0
#include "config_file.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <system_error>
#include <utility>

namespace dpslave::app {

namespace {

constexpr std::chrono::seconds kLookInterval{1};

using Loaded = Result<config::Config, input::Faults>;

/// Whatever happens: a caller waits for it.
Loaded loaded(const ConfigSources& sources, const std::filesystem::path& file,
              const std::filesystem::path& profiles)
{
    try {
        return sources.load(file, profiles);
    } catch (const std::exception& error) { // no memory left
        input::Faults faults;
        faults.push_back({file.string(), 0, 0, std::string{"a system error: "} + error.what()});
        return Failure{std::move(faults)};
    }
}

std::string disk_with(const std::filesystem::path& file)
{
    return "the disk with " + file.string();
}

std::string name_service(const config::ControlConfig& control)
{
    return "the name service, asked for the group \"" + control.operator_group + "\",";
}

} // namespace

ConfigFile::ConfigFile(const config::Config& present, std::filesystem::path profiles, Instant now,
                       std::shared_ptr<const ConfigSources> sources)
    : file_(present.file),
      profiles_(std::move(profiles)),
      sources_(std::move(sources)),
      next_look_(now + kLookInterval)
{
    for (const config::StationConfig& one : present.stations) addresses_[one.name] = one.address;
}

ConfigFile::~ConfigFile()
{
    job_.leave();
}

void ConfigFile::note(const Result<config::Config, input::Faults>& read)
{
    addresses_.clear();
    if (!read) return;
    for (const config::StationConfig& one : read->stations) addresses_[one.name] = one.address;
}

void ConfigFile::add(std::string what, SideJob::Work work)
{
    waiting_.push_back({.what = std::move(what), .work = std::move(work)});
}

void ConfigFile::keep(std::vector<DriverInUse> drivers)
{
    const std::filesystem::path folder = runtime_folder();
    if (folder.empty()) return;
    add("the folder " + folder.string(), [drivers = std::move(drivers), folder]() -> SideJob::Then {
        if (const auto trouble = app::keep(drivers, folder)) spdlog::warn("{}", *trouble);
        return {};
    });
}

void ConfigFile::find_group(const config::ControlConfig& control, Group then)
{
    add(name_service(control), [sources = sources_, control, then = std::move(then)]() -> SideJob::Then {
        return [group = sources->group(control), then] { then(group); };
    });
}

void ConfigFile::forget()
{
    ++reading_;
    std::erase_if(waiting_, [](const Piece& one) { return one.reading != 0; });
}

void ConfigFile::read(std::vector<config::LineConfig> present, std::function<void(ReadConfig&)> then)
{
    forget();
    then_ = std::move(then);
    present_ = std::move(present);
    const unsigned reading = reading_;
    SideJob::Work work = [this, reading, sources = sources_, file = file_,
                          profiles = profiles_]() -> SideJob::Then {
        auto read = std::make_shared<ReadConfig>(ReadConfig{.config = loaded(*sources, file, profiles)});
        return [this, reading, read] {
            note(read->config);
            go_on(reading, read);
        };
    };
    waiting_.push_back({disk_with(file_), std::move(work), reading});
}

/// The file was read: then the name service is asked, and behind it the ports.
void ConfigFile::go_on(unsigned reading, const std::shared_ptr<ReadConfig>& read)
{
    if (reading != reading_) return; // forgotten
    if (!read->config) return then_(*read);
    begin(name_service(read->config->control), [this, reading, read, sources = sources_]() -> SideJob::Then {
        read->group = sources->group(read->config->control);
        return [this, reading, read] { look_at_ports(reading, read); };
    });
}

void ConfigFile::look_at_ports(unsigned reading, const std::shared_ptr<ReadConfig>& read)
{
    if (reading != reading_) return;
    begin("the folder with the ports of the lines",
          [this, reading, read, sources = sources_, present = present_]() -> SideJob::Then {
              for (const config::LineConfig& line : read->config->lines)
                  read->ports.push_back(sources->port_trouble(line.port));
              for (const auto* const lines : {&present, &std::as_const(read->config->lines)})
                  for (const config::LineConfig& line : *lines)
                      for (const std::string& path : {line.port, line.driver_enable.gpio_chip})
                          read->real_paths.add(path, sources->canonical);
              return [this, reading, read] {
                  if (reading == reading_) then_(*read);
              };
          });
}

void ConfigFile::begin(std::string what, SideJob::Work work)
{
    running_ = std::move(what);
    job_.start(std::move(work));
}

void ConfigFile::look()
{
    begin(
        disk_with(file_),
        [this, sources = sources_, file = file_, profiles = profiles_, before = written_]() -> SideJob::Then {
            std::error_code gone;
            const auto written = std::filesystem::last_write_time(file, gone);
            if (gone || written == before) return {};
            auto read = std::make_shared<const Loaded>(loaded(*sources, file, profiles));
            return [this, written, read] {
                written_ = written;
                note(*read);
            };
        });
}

/// False: there is nothing to do, or no thread for it.
bool ConfigFile::start_next()
{
    if (waiting_.empty()) return false;
    running_ = waiting_.front().what;
    if (!job_.start(waiting_.front().work)) return false;
    waiting_.erase(waiting_.begin());
    return true;
}

void ConfigFile::on_time(Instant now)
{
    if (!job_.is_idle() || start_next() || !waiting_.empty() || now < next_look_) return;
    next_look_ = now + kLookInterval;
    look();
}

bool ConfigFile::settle(std::chrono::milliseconds limit)
{
    forget();
    const auto until = std::chrono::steady_clock::now() + limit;
    do {
        const auto left =
            std::chrono::floor<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
        if (!job_.wait(left)) return false;
    } while (start_next());
    return true;
}

std::optional<std::uint8_t> ConfigFile::address_of(const std::string& station) const
{
    const auto found = addresses_.find(station);
    return found != addresses_.end() ? std::optional{found->second} : std::nullopt;
}

} // namespace dpslave::app
