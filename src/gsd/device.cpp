// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/device.hpp"

#include "text.hpp"

namespace dpslave::gsd {
namespace {

constexpr std::size_t kColumn = 19;       ///< where the "=" is
constexpr std::size_t kOctetsInALine = 8; ///< of User_Prm_Data, as in the manual's listing

class Writer {
public:
    std::string write(const Device& device)
    {
        line("#Profibus_DP");
        for (const std::string& each : device.comments) folded(each);
        general(device);
        rates(device);
        slave(device);
        user_prm_data(device);
        station(device);
        for (std::size_t i = 0; i < device.modules.size(); ++i) module(device, i);
        return std::move(out_);
    }

private:
    void line(std::string_view text)
    {
        out_ += text;
        out_ += "\r\n";
    }

    /// A \ at the end would continue the comment for some tools, and swallow the next line.
    void comment(std::string_view text)
    {
        std::string whole = ("; " + std::string{text}).substr(0, kMaxLine);
        if (whole.back() == '\\') whole.back() = '/';
        line(whole);
    }

    void key(std::string_view keyword, std::string_view value)
    {
        std::string text{keyword};
        if (text.size() < kColumn) text.append(kColumn - text.size(), ' ');
        line(text + " = " + std::string{value});
    }
    void key(std::string_view keyword, std::size_t value) { key(keyword, std::to_string(value)); }
    void key(std::string_view keyword, bool value) { key(keyword, std::string_view{value ? "1" : "0"}); }
    void text(std::string_view keyword, std::string_view value) { key(keyword, in_quotes(value)); }

    /// One paragraph as comment lines, broken at blanks, else at commas.
    void folded(std::string_view paragraph)
    {
        constexpr std::size_t width = kMaxLine - 2;
        do {
            std::string_view part = paragraph.substr(0, width);
            if (part.size() < paragraph.size() && paragraph[width] != ' ') {
                const auto blank = part.rfind(' ');
                const auto comma = part.rfind(',');
                if (blank != part.npos && blank > 0)
                    part = part.substr(0, blank);
                else if (comma != part.npos)
                    part = part.substr(0, comma + 1);
            }
            comment(part);
            paragraph = trimmed(paragraph.substr(part.size()));
        } while (!paragraph.empty());
    }

    void general(const Device& device)
    {
        key("GSD_Revision", std::size_t{3});
        text("Vendor_Name", device.vendor);
        text("Model_Name", device.model);
        text("Revision", device.revision);
        key("Ident_Number", hex_word(device.ident));
        key("Protocol_Ident", std::size_t{0}); // PROFIBUS-DP
        key("Station_Type", std::size_t{0});   // slave
        key("FMS_supp", false);
        text("Hardware_Release", device.hardware);
        text("Software_Release", device.software);
        if (!device.description.empty()) text("Info_Text", device.description);
    }

    void rates(const Device& device)
    {
        for (const Baud baud : kBauds)
            if (device.max_tsdr[index_of(baud)].count > 0)
                key(std::string{dpslave::text(baud)} + "_supp", true);
        for (const Baud baud : kBauds)
            if (const Tbit bits = device.max_tsdr[index_of(baud)]; bits.count > 0)
                key("MaxTsdr_" + std::string{dpslave::text(baud)}, std::size_t{bits.count});
    }

    void slave(const Device& device)
    {
        key("Redundancy", false);
        key("Repeater_Ctrl_Sig", std::size_t{device.repeater});
        key("24V_Pins", std::size_t{0});
        key("Slave_Family", std::size_t{device.family});
        key("Freeze_Mode_supp", device.freeze);
        key("Sync_Mode_supp", device.sync);
        key("Fail_Safe", device.fail_safe);
        key("Auto_Baud_supp", true);
        key("Set_Slave_Add_supp", false);
        key("Min_Slave_Intervall", std::size_t{device.min_slave_interval});
        key("Max_Diag_Data_Len", std::size_t{device.max_diag_length});
    }

    void user_prm_data(const Device& device)
    {
        for (const std::string& each : device.prm_comments) comment(each);
        const std::vector<std::uint8_t>& octets = device.user_prm_data;
        key("User_Prm_Data_Len", octets.size());
        if (octets.empty()) return;
        std::string part;
        for (std::size_t i = 0; i < octets.size(); ++i) {
            if (i > 0) part += ',';
            if (i > 0 && i % kOctetsInALine == 0) {
                part += "\\\r\n";
                part.append(kColumn + 3, ' ');
            }
            part += hex_octet(octets[i]);
        }
        key("User_Prm_Data", part);
    }

    void station(const Device& device)
    {
        const bool modular = device.choice_of_modules || device.modules.size() > 1;
        key("Modular_Station", modular);
        key("Max_Module", std::size_t{device.max_module});
        key("Max_Input_Len", std::size_t{device.max_in});
        key("Max_Output_Len", std::size_t{device.max_out});
        key("Max_Data_Len", std::size_t{device.max_data});
        if (modular && !device.choice_of_modules) key("FixPresetModules", true);
    }

    /// Name and identifiers in one line where they fit; 17 octets alone take 84 characters.
    void module(const Device& device, std::size_t index)
    {
        const DeviceModule& module = device.modules[index];
        std::string text = "Module = " + in_quotes(module.name) + ' ';
        std::size_t length = text.size();
        for (std::size_t i = 0; i < module.identifiers.size(); ++i) {
            const bool last = i + 1 == module.identifiers.size();
            if (length + (last ? 4 : 6) > kMaxLine) {
                text += "\\\r\n  ";
                length = 2;
            }
            text += hex_octet(module.identifiers[i]) + (last ? "" : ",");
            length += 5;
        }
        line(text);
        line(std::to_string(index + 1)); // the reference number
        if (!device.choice_of_modules && device.modules.size() > 1) line("Preset = 1");
        line("EndModule");
    }

    std::string out_;
};

/// The code point that `text` begins with, and its octets; U+FFFD for what is no UTF-8.
std::pair<std::uint32_t, std::size_t> code_point(std::string_view text)
{
    const auto octet = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::uint32_t head = octet(0);
    if (head < 0x80) return {head, 1};
    const std::size_t length = head >= 0xF0 ? 4 : head >= 0xE0 ? 3 : head >= 0xC2 ? 2 : 1;
    if (length == 1 || length > text.size()) return {0xFFFD, 1};
    std::uint32_t value = head & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((octet(i) & 0xC0U) != 0x80U) return {0xFFFD, 1};
        value = value << 6 | (octet(i) & 0x3FU);
    }
    return {value, length};
}

} // namespace

std::string write(const Device& device)
{
    return Writer{}.write(device);
}

std::string latin1(std::string_view utf8)
{
    std::string out;
    while (!utf8.empty()) {
        const auto [point, length] = code_point(utf8);
        if (point == '"')
            out += '\'';
        else if (point < 0x20 || point == 0x7F)
            out += ' ';
        else if (point < 0x7F || (point >= 0xA0 && point <= 0xFF))
            out += static_cast<char>(point);
        else
            out += '?';
        utf8.remove_prefix(length);
    }
    return out;
}

} // namespace dpslave::gsd
