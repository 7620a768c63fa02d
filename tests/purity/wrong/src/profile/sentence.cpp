// SPDX-License-Identifier: Apache-2.0
// See dpctl gsd make --ident (this is a comment and may say so).
const char* first = "no Ident_Number: give it with --ident.";
const char* second = "--profile is missing.";
const char* third = "replies are late: see dpctl tune.";
void count_down(int& number)
{
    for (; number > 0; --number) first = "a long - or -- short one";
}
