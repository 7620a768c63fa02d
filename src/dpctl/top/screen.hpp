// SPDX-License-Identifier: Apache-2.0
/// The terminal as one screen, with keys. What it was before comes back on every way out.
#pragma once

#include "keys.hpp"
#include "render_top.hpp"

#include <termios.h>

#include <csignal>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// Standard output is a terminal. From here to the end of this object it shows the alternate screen, echoes
/// nothing and hands each key over at once. Ctrl-Z gives the terminal back while the program stands still.
/// The sequences are those of ECMA-48 and the private modes of xterm that every terminal in use knows.
class Screen {
public:
    explicit Screen(std::ostream& out);
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;
    ~Screen();

    /// Readable as soon as there is something for fetch().
    int fd() const { return epoll_; }

    /// What has come since the last time.
    struct Input {
        bool is_end = false;       ///< SIGINT, SIGTERM, SIGHUP, SIGQUIT, or the terminal has gone
        bool wants_redraw = false; ///< the size is another one, or the program was stopped
        std::vector<Key> keys{};
    };
    Input fetch();

    ScreenSize size() const;
    /// In place of what is there. Lines that fit, without control characters but colours.
    void draw(const std::vector<std::string>& lines);

private:
    void enter();
    void leave();
    void fetch_signals(Input& into);
    void fetch_keys(Input& into);

    std::ostream& out_;
    std::optional<termios> before_; ///< none: standard input is no terminal, there are no keys
    sigset_t signals_before_{};
    int signals_ = -1, epoll_ = -1;
    KeyReader reader_;
};

} // namespace dpslave::dpctl
