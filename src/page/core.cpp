// SPDX-License-Identifier: Apache-2.0
// The script of the page calls these functions: the files of the project go in once, then each request is one
// call. Texts pass through one buffer: the script asks for room, writes, calls, and reads the reply at the
// place returned.
#include "dpslave/configurator/configurator.hpp"

#include <map>

namespace {

using namespace dpslave;

std::string& buffer()
{
    static std::string text;
    return text;
}
std::string& reply()
{
    static std::string text;
    return text;
}
std::map<std::string, std::string, std::less<>>& files()
{
    static std::map<std::string, std::string, std::less<>> all;
    return all;
}

Result<std::string, Unreadable> read_file(const std::string& name)
{
    const auto found = files().find(name);
    if (found != files().end()) return found->second;
    return Failure{Unreadable{"it is not in this page"}};
}

} // namespace

#define DPSLAVE_EXPORT(name) extern "C" __attribute__((export_name(name)))

/// Room for a text of `size` octets, until the next call.
DPSLAVE_EXPORT("room") char* dpslave_room(std::size_t size)
{
    buffer().assign(size, '\0');
    return buffer().data();
}

/// The buffer holds a name of `name_size` octets, then the file's text.
DPSLAVE_EXPORT("add_file") void dpslave_add_file(std::size_t name_size)
{
    files()[buffer().substr(0, name_size)] = buffer().substr(name_size);
}

/// Answers the request in the buffer. The reply stays until the next call.
DPSLAVE_EXPORT("call") const char* dpslave_call()
{
    reply() = configurator::call(buffer(), read_file);
    return reply().data();
}

DPSLAVE_EXPORT("reply_size") std::size_t dpslave_reply_size()
{
    return reply().size();
}
