// SPDX-License-Identifier: Apache-2.0
#include "kept_settings.hpp"

#include <asm/termbits.h>
#include <linux/serial.h>
#include <linux/tty.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace dpslave::io {

struct KeptSettings::Settings {
    termios2 flags{};
    serial_rs485 rs485{};
    bool is_known = false, has_rs485 = false; ///< the driver says so
};

namespace {

struct Flag {
    tcflag_t bit;
    std::string_view name;
    bool harms = true;
};

constexpr Flag kInputFlags[] = {
    {IGNBRK, "IGNBRK"},   {BRKINT, "BRKINT"},      {IGNPAR, "IGNPAR"},      {PARMRK, "PARMRK"},
    {INPCK, "INPCK"},     {ISTRIP, "ISTRIP"},      {INLCR, "INLCR"},        {IGNCR, "IGNCR"},
    {ICRNL, "ICRNL"},     {IUCLC, "IUCLC"},        {IXON, "IXON"},          {IXOFF, "IXOFF"},
    {IMAXBEL, "IMAXBEL"}, {IXANY, "IXANY", false}, {IUTF8, "IUTF8", false},
};
constexpr Flag kOutputFlags[] = {
    {OPOST, "OPOST"}, {OLCUC, "OLCUC"},   {ONLCR, "ONLCR"}, {OCRNL, "OCRNL"},
    {ONOCR, "ONOCR"}, {ONLRET, "ONLRET"}, {OFILL, "OFILL"}, {OFDEL, "OFDEL"},
};
constexpr Flag kLocalFlags[] = {
    {ISIG, "ISIG"},
    {ICANON, "ICANON"},
    {XCASE, "XCASE"},
    {ECHO, "ECHO"},
    {ECHONL, "ECHONL"},
    {IEXTEN, "IEXTEN"},
    {EXTPROC, "EXTPROC"},
    {ECHOE, "ECHOE", false},
    {ECHOK, "ECHOK", false},
    {ECHOCTL, "ECHOCTL", false},
    {ECHOKE, "ECHOKE", false},
    {ECHOPRT, "ECHOPRT", false},
    {NOFLSH, "NOFLSH", false},
    {TOSTOP, "TOSTOP", false},
};
constexpr Flag kControlFlags[] = {
    {CREAD, "CREAD"},
    {HUPCL, "HUPCL", false},
    {CLOCAL, "CLOCAL", false},
    {CRTSCTS, "CRTSCTS", false},
};
constexpr tcflag_t kFormatFlags = CSIZE | PARENB | PARODD | CMSPAR | CSTOPB;
/// The same rate has two forms there; c_ispeed and c_ospeed say it.
constexpr tcflag_t kRateFlags = CBAUD | (CBAUD << IBSHIFT);

/// Puts one part behind the other, as many as there is room for. It allocates nothing.
class Words {
public:
    explicit Words(std::array<char, 240>& text) : text_(text) {}
    Words& operator<<(std::string_view part)
    {
        used_ += part.copy(text_.data() + used_, text_.size() - 1 - used_);
        return *this;
    }
    Words& operator<<(std::uint32_t number)
    {
        std::array<char, 10> digits{};
        const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
        return *this << std::string_view{digits.data(), static_cast<std::size_t>(end - digits.data())};
    }
    /// Begins another part.
    Words& next() { return *this << (used_ == 0 ? "" : ", "); }

private:
    std::array<char, 240>& text_;
    std::size_t used_ = 0;
};

/// True: one of those that differ harms the octets.
template <std::size_t N>
bool tell(const Flag (&flags)[N], tcflag_t wanted, tcflag_t found, Words& words)
{
    bool harms = false;
    tcflag_t unknown = wanted ^ found;
    for (const Flag& flag : flags) {
        unknown &= ~flag.bit;
        if (((wanted ^ found) & flag.bit) == 0) continue;
        harms = harms || flag.harms;
        words.next() << flag.name << ((found & flag.bit) != 0 ? " is on" : " is off");
    }
    if (unknown != 0) words.next() << "other flags differ (" << unknown << ")";
    return harms || unknown != 0;
}

bool is_same_rate(const termios2& a, const termios2& b)
{
    return a.c_ispeed == b.c_ispeed && a.c_ospeed == b.c_ospeed;
}

bool is_same(const termios2& a, const termios2& b)
{
    return a.c_iflag == b.c_iflag && a.c_oflag == b.c_oflag && a.c_lflag == b.c_lflag &&
           a.c_line == b.c_line && (a.c_cflag & ~kRateFlags) == (b.c_cflag & ~kRateFlags) &&
           is_same_rate(a, b) && std::memcmp(a.c_cc, b.c_cc, sizeof a.c_cc) == 0;
}

/// "8E1"
void add_format(tcflag_t flags, Words& words)
{
    const std::uint32_t size = flags & CSIZE;
    const std::uint32_t bits = size == CS8 ? 8 : size == CS7 ? 7 : size == CS6 ? 6 : 5;
    std::string_view parity = (flags & PARODD) != 0 ? "O" : "E";
    if ((flags & CMSPAR) != 0) parity = (flags & PARODD) != 0 ? "M" : "S";
    if ((flags & PARENB) == 0) parity = "N";
    words << bits << parity << ((flags & CSTOPB) != 0 ? "2" : "1");
}

bool is_same(const serial_rs485& a, const serial_rs485& b)
{
    return a.flags == b.flags && a.delay_rts_before_send == b.delay_rts_before_send &&
           a.delay_rts_after_send == b.delay_rts_after_send;
}

/// Says how the mode differs in which the UART itself switches the transceiver.
std::string_view words_of(const serial_rs485& wanted, const serial_rs485& found)
{
    if (((wanted.flags ^ found.flags) & SER_RS485_ENABLED) == 0)
        return "the RS-485 mode of the UART is another one";
    return (found.flags & SER_RS485_ENABLED) != 0 ? "the RS-485 mode of the UART is on"
                                                  : "the RS-485 mode of the UART is off";
}

/// `rs485`: how that mode differs; empty: it does not.
ChangedSettings compare(const termios2& wanted, const termios2& found, std::string_view rs485)
{
    ChangedSettings changed;
    Words words{changed.words};
    bool harms = !rs485.empty();
    if (harms) words.next() << rs485;
    if (!is_same_rate(wanted, found)) {
        harms = true;
        words.next() << (found.c_ispeed != wanted.c_ispeed ? found.c_ispeed : found.c_ospeed)
                     << " instead of " << wanted.c_ospeed << " bit/s";
    }
    if (((wanted.c_cflag ^ found.c_cflag) & kFormatFlags) != 0) {
        harms = true;
        add_format(found.c_cflag, words.next());
        add_format(wanted.c_cflag, words << " instead of ");
    }
    harms = tell(kInputFlags, wanted.c_iflag, found.c_iflag, words) || harms;
    harms = tell(kLocalFlags, wanted.c_lflag, found.c_lflag, words) || harms;
    // Without OPOST the others do nothing.
    const bool harms_output = tell(kOutputFlags, wanted.c_oflag, found.c_oflag, words);
    harms = harms || (harms_output && (found.c_oflag & OPOST) != 0);
    constexpr tcflag_t kOther = ~(kFormatFlags | kRateFlags);
    harms = tell(kControlFlags, wanted.c_cflag & kOther, found.c_cflag & kOther, words) || harms;
    if (wanted.c_line != found.c_line) {
        harms = true;
        words.next() << "line discipline " << std::uint32_t{found.c_line} << " instead of "
                     << std::uint32_t{wanted.c_line};
    }
    if (std::memcmp(wanted.c_cc, found.c_cc, sizeof wanted.c_cc) != 0)
        words.next() << "a control character, VMIN or VTIME is another one";
    changed.harms_octets = harms;
    return changed;
}

std::error_code last_error_of_settings()
{
    return {errno, std::system_category()};
}

} // namespace

KeptSettings::KeptSettings() : noted_(std::make_unique<Settings>()) {}
KeptSettings::KeptSettings(KeptSettings&&) noexcept = default;
KeptSettings& KeptSettings::operator=(KeptSettings&&) noexcept = default;
KeptSettings::~KeptSettings() = default;

void KeptSettings::note(int fd) noexcept
{
    termios2 now{};
    if (::ioctl(fd, TCGETS2, &now) < 0) return;
    noted_->flags = now;
    noted_->is_known = true;
}

void KeptSettings::note_rs485(int fd) noexcept
{
    noted_->has_rs485 = ::ioctl(fd, TIOCGRS485, &noted_->rs485) == 0;
}

std::optional<ChangedSettings> KeptSettings::changed(int fd) const noexcept
{
    termios2 now{};
    if (::ioctl(fd, TCGETS2, &now) < 0 || !noted_->is_known) return std::nullopt;
    serial_rs485 mode{};
    const bool is_moved =
        noted_->has_rs485 && ::ioctl(fd, TIOCGRS485, &mode) == 0 && !is_same(noted_->rs485, mode);
    if (is_same(noted_->flags, now) && !is_moved) return std::nullopt;
    return compare(noted_->flags, now, is_moved ? words_of(noted_->rs485, mode) : std::string_view{});
}

std::error_code KeptSettings::set_again(int fd, std::uint32_t baud) const noexcept
{
    if (!noted_->is_known) return {};
    termios2 wanted = noted_->flags;
    termios2 now{};
    if (::ioctl(fd, TCGETS2, &now) < 0) return last_error_of_settings();
    int discipline = wanted.c_line;
    if (now.c_line != wanted.c_line && ::ioctl(fd, TIOCSETD, &discipline) < 0)
        return last_error_of_settings();
    static_cast<void>(::ioctl(fd, TCFLSH, TCOFLUSH));
    serial_rs485 mode = noted_->rs485;
    if (noted_->has_rs485 && ::ioctl(fd, TIOCGRS485, &mode) == 0 && !is_same(noted_->rs485, mode)) {
        mode = noted_->rs485;
        if (::ioctl(fd, TIOCSRS485, &mode) < 0) return last_error_of_settings();
    }
    wanted.c_cflag &= ~kRateFlags;
    wanted.c_cflag |= BOTHER;
    wanted.c_ispeed = wanted.c_ospeed = baud; // what the driver made of it may not make the same again
    if (::ioctl(fd, TCSETS2, &wanted) < 0 || ::ioctl(fd, TCGETS2, &now) < 0) return last_error_of_settings();
    return is_same(noted_->flags, now) ? std::error_code{}
                                       : std::make_error_code(std::errc::resource_unavailable_try_again);
}

} // namespace dpslave::io
