// SPDX-License-Identifier: Apache-2.0
// For the 590 (this is a comment and may say so).
constexpr bool is_known(unsigned ident)
{
    return ident == 0x0533;
}
