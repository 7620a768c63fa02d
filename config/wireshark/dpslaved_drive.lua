-- SPDX-License-Identifier: Apache-2.0
-- Wireshark reads the drive side of a capture with this: EI-ASCII (link type USER1, 148), of which Wireshark knows
-- nothing, and Modbus RTU (USER2, 149), which its own dissector "mbrtu" reads. docs/guide/wireshark.md is for its
-- readers. Source: EI-ASCII reference, section 1 (docs/reference/drive-protocols.md).

local ei = Proto("eiascii", "EI-ASCII")
local fields = {
    service = ProtoField.string("eiascii.service", "Service"),
    control = ProtoField.uint8("eiascii.control", "Control character", base.HEX,
                               {[0x02] = "STX", [0x03] = "ETX", [0x04] = "EOT", [0x05] = "ENQ", [0x06] = "ACK", [0x15] = "NAK"}),
    address = ProtoField.string("eiascii.address", "Group and unit, each sent twice"),
    channel = ProtoField.string("eiascii.channel", "Channel"),
    mnemonic = ProtoField.string("eiascii.mnemonic", "Mnemonic"),
    value = ProtoField.string("eiascii.value", "Value"),
    rest = ProtoField.bytes("eiascii.rest", "Octets"),
    bcc = ProtoField.uint8("eiascii.bcc", "BCC: exclusive OR behind STX, up to ETX", base.HEX),
}
local flaws = {
    frame = ProtoExpert.new("eiascii.no_frame", "No frame of EI-ASCII", expert.group.PROTOCOL, expert.severity.ERROR),
    bcc = ProtoExpert.new("eiascii.bad_bcc", "The BCC is wrong", expert.group.CHECKSUM, expert.severity.ERROR),
    refused = ProtoExpert.new("eiascii.refused", "The drive refuses", expert.group.RESPONSE_CODE, expert.severity.WARN),
}
ei.fields = fields
ei.experts = flaws

local kStx, kEtx, kEot, kEnq, kAck, kNak = 0x02, 0x03, 0x04, 0x05, 0x06, 0x15
local frame_name, frame_type = Field.new("frame.interface_name"), Field.new("frame.encap_type")

-- Bits are looked at with arithmetic: the library for them differs between versions of Wireshark.
local function exclusive_or(a, b)
    local result, place = 0, 1
    while a > 0 or b > 0 do
        if a % 2 ~= b % 2 then result = result + place end
        a, b, place = math.floor(a / 2), math.floor(b / 2), place * 2
    end
    return result
end

local function printable(range)
    return (range:raw():gsub("[^\32-\126]", function(c) return ("<%02X>"):format(c:byte()) end))
end

-- Puts the rest of a packet that is no frame into the tree. Returns the words for it.
local function no_frame(tree, rest, why)
    if rest then tree:add(fields.rest, rest) end
    tree:add_proto_expert_info(flaws.frame, why)
    return "no frame: " .. why
end

-- STX, mnemonic, data, ETX, BCC: the value that a drive sends, or that is written to it.
local function block(tree, range)
    local length = range:len()
    if length < 5 or range(length - 2, 1):uint() ~= kEtx then return nil, "ETX and BCC are not at its end" end
    tree:add(fields.control, range(0, 1))
    tree:add(fields.mnemonic, range(1, 2), printable(range(1, 2)))
    local value = ""
    if length > 5 then
        value = printable(range(3, length - 5))
        tree:add(fields.value, range(3, length - 5), value)
    end
    tree:add(fields.control, range(length - 2, 1))
    local bcc, right = range(length - 1, 1), 0
    for i = 1, length - 2 do right = exclusive_or(right, range(i, 1):uint()) end
    local item = tree:add(fields.bcc, bcc)
    if bcc:uint() ~= right then
        item:add_proto_expert_info(flaws.bcc, ("BCC is 0x%02X and should be 0x%02X"):format(bcc:uint(), right))
    end
    return printable(range(1, 2)) .. " = " .. value
end

-- EOT, address, then a read or a write.
local function request(tree, range)
    local length = range:len()
    tree:add(fields.control, range(0, 1))
    if length == 1 then return "EOT: the end, or the mnemonic is not known" end
    if length < 7 then return no_frame(tree, range(1), "an address of four characters and more must follow EOT") end
    local group, unit = printable(range(1, 1)), printable(range(3, 1))
    tree:add(fields.address, range(1, 4), group .. unit)
    if range(1, 1):uint() ~= range(2, 1):uint() or range(3, 1):uint() ~= range(4, 1):uint() then
        return no_frame(tree, range(5), "group and unit must stand there twice")
    end
    local at = (" at %s%s"):format(group, unit)
    if range(5, 1):uint() == kStx then
        local words, why = block(tree, range(5))
        return words and "write " .. words .. at or no_frame(tree, range(5), why)
    end
    if range(length - 1, 1):uint() ~= kEnq or length < 8 or length > 9 then
        return no_frame(tree, range(5), "a mnemonic and ENQ, or STX, must follow the address")
    end
    if length == 9 then tree:add(fields.channel, range(5, 1), printable(range(5, 1))) end
    tree:add(fields.mnemonic, range(length - 3, 2), printable(range(length - 3, 2)))
    tree:add(fields.control, range(length - 1, 1))
    return "read " .. printable(range(length - 3, 2)) .. at
end

local function frame(tree, range)
    local first = range(0, 1):uint()
    if first == kEot then return request(tree, range) end
    if first == kStx then
        local words, why = block(tree, range)
        return words and "value " .. words or no_frame(tree, range, why)
    end
    if (first == kAck or first == kNak) and range:len() == 1 then
        tree:add(fields.control, range)
        if first == kAck then return "ACK: accepted" end
        tree:add_proto_expert_info(flaws.refused)
        return "NAK: refused"
    end
    return no_frame(tree, range, "it begins with neither EOT, STX, ACK nor NAK")
end

local function is_of_a_drive()
    local name = frame_name()
    return name ~= nil and name.value:sub(1, 5) == "drive"
end

local types = DissectorTable.get("wtap_encap")
-- What others have for these two link types: it gets what is not ours.
local before = {[wtap.USER1] = types:get_dissector(wtap.USER1), [wtap.USER2] = types:get_dissector(wtap.USER2)}

-- A dissector that finds its packet malformed says so itself, then ends with an error: that is none of this file.
local function let(other, tvb, pinfo, tree)
    local went_well, length = pcall(other.call, other, tvb, pinfo, tree)
    return went_well and length or tvb:len()
end

local function hand_on(tvb, pinfo, tree)
    local kind = frame_type()
    local other = kind and before[kind.value]
    return other and let(other, tvb, pinfo, tree) or 0
end

function ei.dissector(tvb, pinfo, tree)
    if tvb:len() == 0 then return 0 end
    local first = tvb(0, 1):uint()
    local begins = first == kStx or first == kEot or ((first == kAck or first == kNak) and tvb:len() == 1)
    if not begins and not is_of_a_drive() then return hand_on(tvb, pinfo, tree) end
    pinfo.cols.protocol = "EI-ASCII"
    local item = tree:add(ei, tvb())
    local words = frame(item, tvb())
    item:add(fields.service, words):set_generated()
    item:append_text(", " .. words)
    pinfo.cols.info = words
    return tvb:len()
end

-- CRC of Modbus RTU: a frame with its CRC behind it gives 0.
local function crc(range)
    local value = 0xFFFF
    for i = 0, range:len() - 1 do
        value = exclusive_or(value, range(i, 1):uint())
        for _ = 1, 8 do
            local odd = value % 2 == 1
            value = math.floor(value / 2)
            if odd then value = exclusive_or(value, 0xA001) end
        end
    end
    return value
end

-- Why a packet is no frame of the functions that a drive line has; nothing if it is one. Function codes and lengths:
-- EI-ASCII and Modbus reference, section 5.
local function wrong_with(range)
    local length = range:len()
    if length < 4 or length > 256 then return ("%d octets: a frame has 4 to 256"):format(length) end
    if crc(range) ~= 0 then return "the CRC is wrong" end
    local code = range(1, 1):uint()
    local fits
    if code > 128 then fits = length == 5 and range(2, 1):uint() ~= 0
    elseif code == 3 or code == 4 then fits = length == 8 or (length >= 7 and length == 5 + range(2, 1):uint() and length % 2 == 1)
    elseif code == 6 or code == 8 then fits = length == 8
    elseif code == 7 then fits = length == 4 or length == 5
    elseif code == 16 then
        fits = length == 8 or (length >= 11 and length == 9 + range(6, 1):uint() and range(6, 1):uint() == 2 * range(4, 2):uint())
    else return ("function code %d is not used on a drive line"):format(code) end
    return not fits and "its length does not fit the function code" or nil
end

local modbus = Proto("dpslaved_modbus", "Modbus RTU of a drive line")
local no_modbus = ProtoExpert.new("dpslaved_modbus.no_frame", "No frame of Modbus RTU", expert.group.PROTOCOL, expert.severity.ERROR)
modbus.experts = {no_modbus}
local mbrtu = Dissector.get("mbrtu")

-- What is no frame does not go to mbrtu: in Wireshark 4.0 each error in a dissector that Lua has called takes a place on
-- the stack of Lua, and after two hundred of them no Lua dissector works.
function modbus.dissector(tvb, pinfo, tree)
    if tvb:len() == 0 then return 0 end
    local why = wrong_with(tvb())
    if not why then return let(mbrtu, tvb, pinfo, tree) end
    if not is_of_a_drive() then return hand_on(tvb, pinfo, tree) end
    pinfo.cols.protocol = "Modbus RTU"
    pinfo.cols.info = "no frame: " .. why
    tree:add(modbus, tvb()):add_proto_expert_info(no_modbus, why)
    return tvb:len()
end

types:add(wtap.USER1, ei)
types:add(wtap.USER2, modbus)
