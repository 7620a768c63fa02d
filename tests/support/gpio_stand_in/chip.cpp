// SPDX-License-Identifier: Apache-2.0
#include "chip.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace dpslave::stand_in {
namespace {

template <std::size_t N>
void put(std::array<char, N>& place, const std::string& text)
{
    place.fill('\0');
    text.copy(place.data(), N - 1);
}

struct flock lock_of(unsigned line, short type)
{
    struct flock lock {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    lock.l_start = kLocks + line;
    lock.l_len = 1;
    return lock;
}

} // namespace

ChipFile::ChipFile(std::filesystem::path path, const std::string& label, unsigned lines)
    : path_(std::move(path)), fd_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600))
{
    if (fd_ < 0 || ::ftruncate(fd_, sizeof(Chip)) != 0)
        throw std::system_error{errno, std::system_category(), path_.string()};
    void* const place = ::mmap(nullptr, sizeof(Chip), PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    if (place == MAP_FAILED) throw std::system_error{errno, std::system_category(), path_.string()};
    chip_ = static_cast<Chip*>(place);
    put(chip_->label, label);
    chip_->lines = lines;
    chip_->magic = kMagic;
}

ChipFile::~ChipFile()
{
    ::munmap(chip_, sizeof(Chip));
    ::close(fd_);
}

bool ChipFile::is_taken(unsigned line) const
{
    struct flock lock = lock_of(line, F_WRLCK);
    return ::fcntl(fd_, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

void ChipFile::occupy(unsigned line, const std::string& consumer)
{
    struct flock lock = lock_of(line, F_WRLCK);
    if (::fcntl(fd_, F_OFD_SETLK, &lock) != 0)
        throw std::system_error{errno, std::system_category(), path_.string()};
    put(chip_->line.at(line).consumer, consumer);
}

void ChipFile::remove()
{
    chip_->gone = 1;
    ++chip_->generation;
}

void ChipFile::come_back()
{
    for (Line& one : chip_->line) one.level.high = 0;
    chip_->gone = 0;
}

void ChipFile::watch(unsigned line, const std::filesystem::path& port, unsigned baud)
{
    chip_->watch.line = line;
    chip_->watch.baud = baud;
    put(chip_->watch.port, port.string());
}

} // namespace dpslave::stand_in
