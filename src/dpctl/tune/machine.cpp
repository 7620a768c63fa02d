// SPDX-License-Identifier: Apache-2.0
#include "machine.hpp"

#include "proc_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <string_view>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

bool has_word(std::string_view text, std::string_view word)
{
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const bool begins = at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t';
        const std::size_t end = at + word.size();
        if (begins && (end == text.size() || text[end] == ' ' || text[end] == '\n')) return true;
    }
    return false;
}

/// How many processors a list like "0-2,5" names.
int count_of(const std::string& list)
{
    int count = 0;
    std::size_t at = 0;
    while (at < list.size()) {
        const std::string part = list.substr(at, std::min(list.find(',', at), list.size()) - at);
        at += part.size() + 1;
        const auto dash = part.find('-');
        const int first = std::atoi(part.c_str());
        count += dash == std::string::npos ? 1 : std::atoi(part.c_str() + dash + 1) - first + 1;
    }
    return count;
}

void read_kernel(const fs::path& root, MachineFacts& machine)
{
    const fs::path kernel = root / "proc/sys/kernel";
    machine.release = file_text(kernel / "osrelease").value_or("");
    machine.version = file_text(kernel / "version").value_or("");
    // "PREEMPT RT" up to 5.x, "PREEMPT_RT" since; /sys/kernel/realtime has gone and come back.
    machine.preempt_rt = file_number(root / "sys/kernel/realtime").value_or(0) == 1 ||
                         machine.version.find("PREEMPT_RT") != std::string::npos ||
                         machine.version.find("PREEMPT RT") != std::string::npos;
    machine.threaded_irqs =
        machine.preempt_rt || has_word(file_text(root / "proc/cmdline").value_or(""), "threadirqs");
    if (const auto runtime = file_number(kernel / "sched_rt_runtime_us"))
        machine.rt_runtime_us = static_cast<int>(*runtime);
}

void read_idle_states(const fs::path& cpu, MachineFacts& machine)
{
    for (const std::string& state : names_in(cpu / "cpuidle")) {
        const fs::path folder = cpu / "cpuidle" / state;
        const auto latency = file_number(folder / "latency");
        if (!latency || file_number(folder / "disable").value_or(0) != 0) continue;
        if (machine.idle_exit_us && *machine.idle_exit_us >= *latency) continue;
        machine.idle_exit_us = static_cast<int>(*latency);
        machine.deepest_idle = file_text(folder / "name").value_or(state);
    }
}

void read_processors(const fs::path& root, MachineFacts& machine)
{
    const fs::path cpus = root / "sys/devices/system/cpu";
    machine.processors = count_of(file_text(cpus / "online").value_or(""));
    machine.isolated = file_text(cpus / "isolated").value_or("");
    for (const std::string& name : names_in(cpus)) {
        if (name.rfind("cpu", 0) != 0 || name.size() < 4 ||
            name.find_first_not_of("0123456789", 3) != std::string::npos)
            continue;
        if (auto governor = file_text(cpus / name / "cpufreq/scaling_governor"))
            machine.governors.push_back(*std::move(governor));
        read_idle_states(cpus / name, machine);
    }
    std::sort(machine.governors.begin(), machine.governors.end());
    machine.governors.erase(std::unique(machine.governors.begin(), machine.governors.end()),
                            machine.governors.end());
}

/// A read gives the limit that stands now; 2 000 000 000 us is the kernel's word for "none".
std::optional<int> read_latency_limit(const fs::path& root)
{
    constexpr std::int32_t kNone = 2'000'000'000;
    std::array<char, sizeof(std::int32_t)> octets{};
    std::ifstream file(root / "dev/cpu_dma_latency", std::ios::binary);
    if (!file.read(octets.data(), octets.size())) return std::nullopt;
    const auto limit = std::bit_cast<std::int32_t>(octets);
    if (limit < 0 || limit >= kNone) return std::nullopt;
    return limit;
}

bool is_virtual(const fs::path& root)
{
    const std::string flags = line_value(file_text(root / "proc/cpuinfo").value_or(""), "flags");
    if (has_word(flags, "hypervisor") || file_text(root / "sys/hypervisor/type")) return true;
    // ARM: a hypervisor's node, or the board "virt" of QEMU; entries of the device tree end with NUL.
    std::error_code error;
    const fs::path tree = root / "proc/device-tree";
    return fs::exists(tree / "hypervisor", error) ||
           file_text(tree / "compatible").value_or("").find("linux,dummy-virt") != std::string::npos;
}

void read_threads(const fs::path& root, MachineFacts& machine)
{
    for (const int pid : numbers_in(root / "proc")) {
        const fs::path folder = root / "proc" / std::to_string(pid);
        const auto leader = read_thread(folder);
        if (!leader) continue;
        if (leader->kernel) {
            if (leader->name.rfind("kworker/u", 0) == 0) machine.unbound_workers.push_back(*leader);
            continue;
        }
        for (const int tid : numbers_in(folder / "task"))
            if (auto thread = read_thread(folder / "task" / std::to_string(tid));
                thread && thread->is_realtime())
                machine.realtime_threads.push_back(*std::move(thread));
    }
}

} // namespace

MachineFacts read_machine(const fs::path& root)
{
    MachineFacts machine;
    read_kernel(root, machine);
    read_processors(root, machine);
    machine.latency_limit_us = read_latency_limit(root);
    machine.virtual_machine = is_virtual(root);
    read_threads(root, machine);
    return machine;
}

std::optional<ProcessFacts> read_process(const fs::path& root, int pid)
{
    const fs::path folder = root / "proc" / std::to_string(pid);
    const auto status = file_text(folder / "status");
    if (!status) return std::nullopt;
    ProcessFacts process;
    // A kernel without memory management has no such line.
    if (const std::string locked = line_value(*status, "VmLck"); !locked.empty())
        process.locked_kib = std::strtoull(locked.c_str(), nullptr, 10);
    for (const int tid : numbers_in(folder / "task"))
        if (auto thread = read_thread(folder / "task" / std::to_string(tid)))
            process.threads.push_back(*std::move(thread));
    return process;
}

} // namespace dpslave::io
