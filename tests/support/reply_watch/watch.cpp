// SPDX-License-Identifier: Apache-2.0
#include "watch.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace dpslave::reply_watch {

Watch::Watch(const std::filesystem::path& record)
{
    const int fd = ::open(record.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    void* place = MAP_FAILED;
    if (fd >= 0 && ::ftruncate(fd, sizeof(Record)) == 0) // zeros are an empty record
        place = ::mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (place == MAP_FAILED) throw std::system_error{errno, std::system_category(), record.string()};
    ::close(fd);
    record_ = static_cast<Record*>(place);
}

Watch::~Watch()
{
    ::munmap(record_, sizeof(Record));
}

void Watch::watch(const std::filesystem::path& port, std::chrono::nanoseconds window)
{
    const std::string path = port;
    if (path.size() >= record_->port.size()) throw std::length_error{path};
    record_->window = window.count();
    path.copy(record_->port.data(), path.size());
}

} // namespace dpslave::reply_watch
