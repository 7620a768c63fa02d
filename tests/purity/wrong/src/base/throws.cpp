// SPDX-License-Identifier: Apache-2.0
/// Throws, and so compiles only where there are exceptions: tests/purity/freestanding.sh has to find it.
int positive(int number)
{
    if (number < 0) throw number;
    return number;
}
