// SPDX-License-Identifier: Apache-2.0
#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DPSLAVE_OWN_MALLOC 0
#elif defined(__GLIBC__)
#define DPSLAVE_OWN_MALLOC 1
#else
#define DPSLAVE_OWN_MALLOC 0
#endif

namespace {

thread_local bool is_counted = false;
std::atomic<std::uint64_t> counted{0};

void count_one() noexcept
{
    if (is_counted) counted.fetch_add(1, std::memory_order_relaxed);
}

} // namespace

namespace dpslave::test {

CountAllocations::CountAllocations()
{
    counted = 0;
    is_counted = true;
}

CountAllocations::~CountAllocations()
{
    is_counted = false;
}

std::uint64_t allocations()
{
    return counted;
}

} // namespace dpslave::test

#if DPSLAVE_OWN_MALLOC

// glibc's own names for what these stand in front of. operator new comes here as well.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size)
{
    count_one();
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size)
{
    count_one();
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size)
{
    count_one();
    return __libc_realloc(memory, size);
}
void free(void* memory)
{
    if (memory != nullptr) count_one(); // what is freed was allocated: neither belongs here
    __libc_free(memory);
}
}

#else

void* operator new(std::size_t size)
{
    count_one();
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc{};
}
void* operator new[](std::size_t size)
{
    return ::operator new(size);
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
    std::free(memory);
}

#endif
