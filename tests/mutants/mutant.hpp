// SPDX-License-Identifier: Apache-2.0
/// Stands at the top of each source of the copy in which every mutant is (tools/run mutants): which of them
/// is in force. DPSLAVE_MUTANT=17 in the environment puts one in force. With DPSLAVE_MUTANTS_SERVE the
/// program runs its tests again and again, each time in a process of its own: to start it anew would take
/// longer than most tests.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace dpslave::mutants {

/// More than there are: tests/mutants/run.py numbers them from 1.
inline constexpr int kMost = 16'384;

// Set before anything else of the program runs: tables are filled before main().
inline int number_in_force = 0;
inline const char* reached_file = nullptr; ///< where to write which mutants the run has come to
inline bool is_reached[kMost] = {};

inline bool is(int number)
{
    if (reached_file != nullptr) is_reached[number] = true;
    return number_in_force == number;
}

/// The value of a switch of which the case `label` is taken out; an octet as a wider number, for 255 may be
/// another case.
template <class T, class Label>
auto without_case(T value, int number, Label label)
{
    using Wider =
        typename std::conditional_t<std::is_enum_v<T>, std::type_identity<T>, std::common_type<T, int>>::type;
    return is(number) && value == label ? static_cast<Wider>(-1) : static_cast<Wider>(value);
}

/// In place of a static_assert: the compiler would refuse the mutant.
inline bool compiles(bool condition)
{
    if (!condition) ::_exit(99);
    return true;
}

inline void write_reached()
{
    std::FILE* const file = std::fopen(reached_file, "w");
    if (file == nullptr) return;
    for (int i = 0; i < kMost; ++i)
        if (is_reached[i]) std::fprintf(file, "%d\n", i);
    std::fclose(file);
}

/// Reads "NUMBER SECONDS FILE FILTER" line by line: the mutant, the limit of processor time, where to write
/// what was reached
/// ("-": nowhere), the filter of gtest. Returns in the process that runs the tests. Says "ENDED STATUS
/// MICROSECONDS" of each.
inline void serve()
{
    static char line[1 << 20];
    while (std::fgets(line, sizeof line, stdin) != nullptr) {
        std::fflush(stdout);
        const pid_t child = ::fork();
        if (child == 0) {
            line[std::strcspn(line, "\n")] = '\0';
            number_in_force = std::atoi(std::strtok(line, " "));
            const auto seconds = static_cast<unsigned>(std::atoi(std::strtok(nullptr, " ")));
            const char* const file = std::strtok(nullptr, " ");
            if (std::strcmp(file, "-") != 0) reached_file = file;
            ::setenv("GTEST_FILTER", std::strtok(nullptr, " "), 1);
            const rlimit cpu{seconds, seconds + 1};
            const rlimit memory{4UL << 30, 4UL << 30};
            const rlimit none{0, 0};
            ::setrlimit(RLIMIT_CPU, &cpu);
            ::setrlimit(RLIMIT_AS, &memory);
            ::setrlimit(RLIMIT_CORE, &none);
            ::alarm(60 + 30 * seconds); // what waits for ever uses no processor time
            ::dup2(::open("/dev/null", O_RDWR), 0);
            if (reached_file != nullptr) std::atexit(write_reached);
            return;
        }
        int status = 0;
        rusage used{};
        ::wait4(child, &status, 0, &used);
        std::printf("\nENDED %d %ld\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
                    1'000'000 * (used.ru_utime.tv_sec + used.ru_stime.tv_sec) + used.ru_utime.tv_usec +
                        used.ru_stime.tv_usec);
        std::fflush(stdout);
    }
    std::exit(0);
}

/// Before the tables of all sources are filled; each source has this function, the first one does it.
[[gnu::constructor(101)]] inline void begin()
{
    static bool done = false;
    if (done) return;
    done = true;
    if (const char* const text = std::getenv("DPSLAVE_MUTANT")) number_in_force = std::atoi(text);
    if (std::getenv("DPSLAVE_MUTANTS_SERVE") != nullptr) serve();
}

} // namespace dpslave::mutants
