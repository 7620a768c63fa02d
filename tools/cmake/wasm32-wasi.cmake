# SPDX-License-Identifier: Apache-2.0
# WebAssembly with Debian's clang, wasi-libc and the libc++ of that clang: no exceptions, no file system, no threads.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
