-- SPDX-License-Identifier: Apache-2.0
-- Wireshark reads PROFIBUS with this: telegrams of layer 2 (FDL), and the services of DP in them. Link type 257
-- (PROFIBUS_DL) in a pcapng file, for which Wireshark 4.0 has no type of its own; and USER0 (147). "dpctl trace --output"
-- makes such files. docs/guide/wireshark.md is for its readers. Source of all tables: wire reference 2 to 5
-- (docs/reference/profibus-dp.md). The names of the services are those of "dpctl trace".

local profibus = Proto("profibus", "PROFIBUS DP")
local fields, flaws = {}, {}

local function field(name, make, label, ...)
    fields[name] = make("profibus." .. name, label, ...)
    return fields[name]
end

-- One octet of bits, highest first: {mask, name of the filter, words}.
local function bits(group, list)
    local made = {}
    for _, bit in ipairs(list) do
        made[#made + 1] = field(group .. "." .. bit[2], ProtoField.bool, bit[3], 8, nil, bit[1])
    end
    return made
end

local function flaw(name, words, group, severity)
    flaws[name] = ProtoExpert.new("profibus." .. name, words, group, severity)
end

local kDelimiters = {[0x10] = "SD1: no data", [0x68] = "SD2: variable length", [0xA2] = "SD3: eight octets of data",
                     [0xDC] = "SD4: token", [0xE5] = "SC: short acknowledge"}
local kSaps = {[48] = "MS2 connection (DP-V1)", [49] = "MS2 resource manager (DP-V1)", [50] = "MS1 alarm acknowledge (DP-V1)",
               [51] = "MS1 read and write (DP-V1)", [53] = "Set_Ext_Prm (DP-V2)", [54] = "master to master",
               [55] = "Set_Slave_Add", [56] = "RD_Inp", [57] = "RD_Outp", [58] = "Global_Control", [59] = "Get_Cfg",
               [60] = "Slave_Diag", [61] = "Set_Prm", [62] = "Chk_Cfg"}
local kRequests = {[0] = "time event", "reserved", "reserved", "SDA low: send data with acknowledge",
                   "SDN low: send data, no acknowledge", "SDA high: send data with acknowledge",
                   "SDN high: send data, no acknowledge", "MSRD: send and request data, multicast reply", "reserved",
                   "FDL status", "reserved", "reserved", "SRD low: send and request data",
                   "SRD high: send and request data", "ident", "LSAP status"}
local kReplies = {[0] = "OK: acknowledged", "UE: user error", "RR: no resource for the data",
                  "RS: service or SAP not activated", "reserved", "reserved", "reserved", "reserved",
                  "DL: data, low priority", "NR: no data to return",
                  "DH: data, high priority (in Data_Exchange: a diagnosis waits)", "reserved",
                  "RDL: data, low priority; what was sent was not taken",
                  "RDH: data, high priority; what was sent was not taken", "reserved", "reserved"}
local kStations = {[0] = "slave", "master, not ready for the ring", "master, ready for the ring", "master in the ring"}
-- Functions of a request that are answered: SDA, MSRD, FDL status, SRD, ident, LSAP status.
local kAnswered = {[3] = true, [5] = true, [7] = true, [9] = true, [12] = true, [13] = true, [14] = true, [15] = true}
local kSrdLow, kSrdHigh = 12, 13

field("service", ProtoField.string, "Service")
field("sd", ProtoField.uint8, "Start delimiter", base.HEX, kDelimiters)
field("le", ProtoField.uint8, "LE: octets from DA to the last one of the data")
field("ler", ProtoField.uint8, "LEr: LE repeated")
field("sd2", ProtoField.uint8, "Start delimiter repeated", base.HEX)
field("da", ProtoField.uint8, "DA: to station", base.DEC, nil, 0x7F)
field("sa", ProtoField.uint8, "SA: from station", base.DEC, nil, 0x7F)
field("addr", ProtoField.uint8, "Station, as sender or receiver")
field("fc", ProtoField.uint8, "FC", base.HEX)
field("fc.request", ProtoField.bool, "Request", 8, nil, 0x40)
field("fc.fcb", ProtoField.bool, "FCB: frame count bit", 8, nil, 0x20)
field("fc.fcv", ProtoField.bool, "FCV: the frame count bit counts", 8, nil, 0x10)
field("fc.function", ProtoField.uint8, "Function", base.DEC, kRequests, 0x0F)
field("fc.station", ProtoField.uint8, "Sent by a", base.DEC, kStations, 0x30)
field("fc.reply", ProtoField.uint8, "Reply", base.DEC, kReplies, 0x0F)
field("dsap", ProtoField.uint8, "DSAP: service access point of the receiver")
field("ssap", ProtoField.uint8, "SSAP: service access point of the sender")
field("data", ProtoField.bytes, "Data")
field("outputs", ProtoField.bytes, "Outputs: from the master")
field("inputs", ProtoField.bytes, "Inputs: from the slave")
field("fcs", ProtoField.uint8, "FCS: sum of the octets from DA on", base.HEX)
field("ed", ProtoField.uint8, "End delimiter", base.HEX)
field("request_in", ProtoField.framenum, "Answers the request in frame", base.NONE, frametype.REQUEST)
field("since_request", ProtoField.relative_time, "Since the first character of the request")
field("ident", ProtoField.uint16, "Ident_Number", base.HEX)

field("prm.status", ProtoField.uint8, "Station_status", base.HEX)
local kPrmStatus = bits("prm", {{0x80, "lock_req", "Lock_Req: the slave is for this master"},
                                {0x40, "unlock_req", "Unlock_Req: the slave is free for other masters"},
                                {0x20, "sync_req", "Sync_Req: Sync will be used"},
                                {0x10, "freeze_req", "Freeze_Req: Freeze will be used"},
                                {0x08, "wd_on", "WD_On: the watchdog is on"}})
field("prm.wd_fact_1", ProtoField.uint8, "WD_Fact_1")
field("prm.wd_fact_2", ProtoField.uint8, "WD_Fact_2")
field("prm.min_tsdr", ProtoField.uint8, "min T_SDR in bit times (0: as before)")
field("prm.group", ProtoField.uint8, "Group_Ident, a bit for each group", base.HEX)
field("prm.user", ProtoField.bytes, "User_Prm_Data")
field("cfg.identifier", ProtoField.bytes, "Identifier")
field("gc.command", ProtoField.uint8, "Control_Command", base.HEX)
local kCommands = {{0x20, "sync", "Sync"}, {0x10, "unsync", "Unsync"}, {0x08, "freeze", "Freeze"},
                   {0x04, "unfreeze", "Unfreeze"}, {0x02, "clear_data", "Clear_Data"}}
local kCommandBits = bits("gc", kCommands)
field("gc.group", ProtoField.uint8, "Group_Select, a bit for each group (0: all)", base.HEX)
field("ssa.address", ProtoField.uint8, "New_Slave_Add")
field("ssa.no_change", ProtoField.uint8, "No_Add_Chg (not 0: it cannot be changed again)", base.HEX)
field("ssa.data", ProtoField.bytes, "Rem_Slave_Data")
local kDiagnosis = {
    {"Station_status_1", {{0x80, "master_lock", "Master_Lock"}, {0x40, "prm_fault", "Prm_Fault: Set_Prm was refused"},
        {0x20, "invalid_slave_response", "Invalid_Slave_Response"}, {0x10, "not_supported", "Not_Supported"},
        {0x08, "ext_diag", "Ext_Diag: the device reports a fault"}, {0x04, "cfg_fault", "Cfg_Fault: Chk_Cfg was refused"},
        {0x02, "station_not_ready", "Station_Not_Ready: not ready for Data_Exchange"},
        {0x01, "station_non_existent", "Station_Non_Existent"}}},
    {"Station_status_2", {{0x80, "deactivated", "Deactivated"}, {0x20, "sync_mode", "Sync_Mode"},
        {0x10, "freeze_mode", "Freeze_Mode"}, {0x08, "wd_on", "WD_On: the watchdog is on"}, {0x04, "always", "always 1"},
        {0x02, "stat_diag", "Stat_Diag: there are no valid inputs yet"},
        {0x01, "prm_req", "Prm_Req: the slave waits for Set_Prm"}}},
    {"Station_status_3", {{0x80, "ext_diag_overflow", "Ext_Diag_Overflow: there is more than fits"}}}}
for i, octet in ipairs(kDiagnosis) do
    octet.field = field("diag.status_" .. i, ProtoField.uint8, octet[1], base.HEX)
    octet.bits = bits("diag", octet[2])
end
-- Those of octet 1 that are more than the way to Data_Exchange.
local kFaults = {}
for _, bit in ipairs(kDiagnosis[1][2]) do
    if bit[2]:find("fault") or bit[2] == "not_supported" or bit[2] == "ext_diag" then kFaults[#kFaults + 1] = bit end
end
field("diag.master", ProtoField.uint8, "Master_Add (255: no master)")
field("diag.block", ProtoField.bytes, "Block")

flaw("no_telegram", "No telegram", expert.group.PROTOCOL, expert.severity.ERROR)
flaw("bad_fcs", "The FCS is wrong", expert.group.CHECKSUM, expert.severity.ERROR)
flaw("contents", "The contents contradict the service", expert.group.PROTOCOL, expert.severity.WARN)
flaw("refused", "The slave refuses", expert.group.RESPONSE_CODE, expert.severity.WARN)
flaw("reported", "The slave reports a fault", expert.group.RESPONSE_CODE, expert.severity.NOTE)
profibus.fields = fields
profibus.experts = flaws

-- What one packet is shown with: its tree, and the words for the column Info.
local View = {}
View.__index = View
function View:says(words, ...) self.words[#self.words + 1] = select("#", ...) > 0 and words:format(...) or words end
function View:complains(item, name, words)
    item:add_proto_expert_info(flaws[name], words)
    if name ~= "reported" then self:says("[%s]", words) end
end

local function add_bits(tree, octet, list)
    for _, one in ipairs(list) do tree:add(one, octet) end
end

-- Bits are looked at with arithmetic: the library for them differs between versions of Wireshark.
local function is_set(value, mask) return math.floor(value / mask) % 2 == 1 end

-- The names of those bits of `list` that are set: what stands before the colon.
local function set_bits(value, list)
    local names = {}
    for _, bit in ipairs(list) do
        if is_set(value, bit[1]) and bit[2] ~= "always" then names[#names + 1] = bit[3]:match("^[^:]+") end
    end
    return names
end

-- False, with a complaint, unless there are at least `least` octets.
local function has(view, tree, data, least, service)
    local length = data and data:len() or 0
    if length >= least then return true end
    if data then tree:add(fields.data, data) end
    view:complains(tree, "contents", ("%s has at least %d octets, here are %d"):format(service, least, length))
    return false
end

local function set_prm(view, tree, data)
    if not has(view, tree, data, 7, "Set_Prm") then return end
    local status, fact_1, fact_2 = data(0, 1):uint(), data(1, 1):uint(), data(2, 1):uint()
    add_bits(tree:add(fields["prm.status"], data(0, 1)), data(0, 1), kPrmStatus)
    tree:add(fields["prm.wd_fact_1"], data(1, 1))
    tree:add(fields["prm.wd_fact_2"], data(2, 1)):append_text((" (%d ms with the base of 10 ms)"):format(10 * fact_1 * fact_2))
    tree:add(fields["prm.min_tsdr"], data(3, 1))
    tree:add(fields.ident, data(4, 2))
    tree:add(fields["prm.group"], data(6, 1))
    if data:len() > 7 then tree:add(fields["prm.user"], data(7)) end
    local lock = is_set(status, 0x40) and "Unlock" or is_set(status, 0x80) and "Lock" or "neither Lock nor Unlock"
    local watchdog = is_set(status, 0x08) and ("watchdog %d ms"):format(10 * fact_1 * fact_2) or "no watchdog"
    view:says("%s, ident 0x%04X, %s", lock, data(4, 2):uint(), watchdog)
end

local function count(units, words, consistent)
    return ("%d %s%s%s"):format(units, words and "word" or "octet", units == 1 and "" or "s",
                                consistent and ", consistent as a whole" or "")
end

-- One identifier of Cfg_Data in words, and how many octets belong to it.
local function identifier(data, at)
    local octet = data(at, 1):uint()
    local kind = math.floor(octet / 16) % 4
    if kind ~= 0 then
        local side = kind == 1 and " in" or kind == 2 and " out" or " in and as many out"
        return count(octet % 16 + 1, is_set(octet, 0x40), is_set(octet, 0x80)) .. side, 1
    end
    local form, vendor, length, words = math.floor(octet / 64), octet % 16 == 15 and 0 or octet % 16, 1, {}
    for _, side in ipairs({{2, "out"}, {1, "in"}}) do
        if is_set(form, side[1]) then
            if at + length < data:len() then
                local one = data(at + length, 1):uint()
                words[#words + 1] = count(one % 64 + 1, is_set(one, 0x40), is_set(one, 0x80)) .. " " .. side[2]
            end
            length = length + 1
        end
    end
    if #words == 0 then words[1] = "no inputs or outputs" end
    if vendor > 0 then words[#words + 1] = ("%d octets of the vendor"):format(vendor) end
    return table.concat(words, ", "), length + vendor
end

local function cfg(view, tree, data)
    if not has(view, tree, data, 1, "Cfg_Data") then return end
    local at = 0
    while at < data:len() do
        local words, length = identifier(data, at)
        local taken = math.min(length, data:len() - at)
        local item = tree:add(fields["cfg.identifier"], data(at, taken)):append_text(" (" .. words .. ")")
        if taken < length then view:complains(item, "contents", "an identifier announces octets that are not there") end
        at = at + length
    end
    view:says("%s", data:bytes():tohex(false, " "))
end

-- One block of the extended diagnosis in words, and its length.
local function diagnosis_block(data, at)
    local octet = data(at, 1):uint()
    local kind, number = math.floor(octet / 64), octet % 64
    if kind == 0 then return ("device-related, %d octets"):format(number), number end
    if kind == 1 then return ("identifier-related, %d octets"):format(number), number end
    if kind == 2 then return ("channel-related, identifier %d"):format(number), 3 end
    return ("revision %d of the device"):format(number), 1
end

local function slave_diag(view, tree, data)
    if not has(view, tree, data, 6, "Slave_Diag") then return end
    local set = {}
    for i, octet in ipairs(kDiagnosis) do
        local range = data(i - 1, 1)
        add_bits(tree:add(octet.field, range), range, octet.bits)
        for _, name in ipairs(set_bits(range:uint(), octet[2])) do set[#set + 1] = name end
    end
    local master = data(3, 1):uint()
    tree:add(fields["diag.master"], data(3, 1))
    tree:add(fields.ident, data(4, 2))
    view:says("%s, %s, ident 0x%04X", #set > 0 and table.concat(set, ", ") or "no bit set",
              master == 255 and "no master" or "of master " .. master, data(4, 2):uint())
    local faults = set_bits(data(0, 1):uint(), kFaults)
    if #faults > 0 then view:complains(tree, "reported", "The slave reports " .. table.concat(faults, ", ")) end
    local at = 6
    while at < data:len() do
        local words, length = diagnosis_block(data, at)
        local taken = math.max(1, math.min(length, data:len() - at))
        local item = tree:add(fields["diag.block"], data(at, taken)):append_text(" (" .. words .. ")")
        if taken ~= length then return view:complains(item, "contents", "the header of a block and its length disagree") end
        at = at + length
    end
end

local function global_control(view, tree, data)
    if not has(view, tree, data, 2, "Global_Control") then return end
    local command, group = data(0, 1):uint(), data(1, 1):uint()
    add_bits(tree:add(fields["gc.command"], data(0, 1)), data(0, 1), kCommandBits)
    tree:add(fields["gc.group"], data(1, 1))
    local names = set_bits(command, kCommands)
    view:says("%s, %s", #names > 0 and table.concat(names, ", ") or "Operate",
              group == 0 and "all slaves" or ("groups 0x%02X"):format(group))
    if data:len() > 2 then
        view:complains(tree:add(fields.data, data(2)), "contents", "Global_Control has 2 octets: slaves ignore it")
    end
end

local function set_slave_add(view, tree, data)
    if not has(view, tree, data, 4, "Set_Slave_Add") then return end
    tree:add(fields["ssa.address"], data(0, 1))
    tree:add(fields.ident, data(1, 2))
    tree:add(fields["ssa.no_change"], data(3, 1))
    if data:len() > 4 then tree:add(fields["ssa.data"], data(4)) end
    view:says("new address %d, ident 0x%04X", data(0, 1):uint(), data(1, 2):uint())
end

local function octets(name)
    return function(view, tree, data)
        if not data then return end
        tree:add(fields[name], data)
        view:says("%s%s", data(0, math.min(16, data:len())):bytes():tohex(false, " "), data:len() > 16 and " ..." or "")
    end
end

local kOfRequests = {[55] = set_slave_add, [58] = global_control, [61] = set_prm, [62] = cfg}
local kOfReplies = {[56] = octets("inputs"), [57] = octets("outputs"), [59] = cfg, [60] = slave_diag}

-- The words of "dpctl trace" (service_name of src/dpctl/decode).
local function service_of(sd, is_request, fc_function, own_sap, dsap)
    if is_request and fc_function ~= kSrdLow and fc_function ~= kSrdHigh and not dsap then
        return "request, " .. kRequests[fc_function]
    end
    if own_sap then return (kSaps[own_sap] or "SAP " .. own_sap) .. (is_request and "" or ", reply") end
    if sd == 0x10 then return is_request and "Data_Exchange without data" or "acknowledgement without data" end
    return is_request and "Data_Exchange" or "Data_Exchange, reply"
end

-- Which request a reply belongs to. Wireshark dissects the frames of a file in their order once, later in any order.
local asked, answered = {}, {}
function profibus.init() asked, answered = {}, {} end

local frame_interface, frame_name = Field.new("frame.interface_id"), Field.new("frame.interface_name")

local function interface()
    local id = frame_interface()
    return id and id.value or 0
end

local function note_request(pinfo, da, service)
    if not pinfo.visited then asked[interface()] = {frame = pinfo.number, da = da, at = pinfo.rel_ts, service = service} end
end

-- `sa` is nil with SC, which has no sender. What it answers is not seen from a short reply itself: it is said.
local function note_reply(view, pinfo, tree, sa, is_short)
    local request = asked[interface()]
    if not pinfo.visited and request and (not sa or request.da == sa) then
        answered[pinfo.number] = {request = request, took = pinfo.rel_ts - request.at}
        asked[interface()] = nil
    end
    local found = answered[pinfo.number]
    if not found then return end
    tree:add(fields.request_in, found.request.frame):set_generated()
    local ns = math.max(0, math.floor(found.took * 1e9 + 0.5))
    tree:add(fields.since_request, NSTime.new(math.floor(ns / 1000000000), ns % 1000000000)):set_generated()
    if is_short then view:says("to %s of frame %d", found.request.service, found.request.frame) end
end

local function add_fc(view, tree, fc)
    local item = tree:add(fields.fc, fc)
    item:add(fields["fc.request"], fc)
    local is_request, fc_function = fc:bitfield(1, 1) == 1, fc:bitfield(4, 4)
    if is_request then
        item:add(fields["fc.fcb"], fc)
        item:add(fields["fc.fcv"], fc)
        item:add(fields["fc.function"], fc)
        item:append_text(" (request, " .. kRequests[fc_function] .. ")")
    else
        item:add(fields["fc.station"], fc)
        item:add(fields["fc.reply"], fc)
        item:append_text(" (reply, " .. kReplies[fc_function] .. ")")
        if fc_function >= 1 and fc_function <= 3 then view:complains(item, "refused", kReplies[fc_function])
        elseif fc_function ~= 8 then view:says(kReplies[fc_function]:match("^[^:]+")) end
    end
    return is_request, fc_function
end

-- From DA to the last octet of the data.
local function body(view, pinfo, tree, sd, range)
    local da, sa, fc = range(0, 1), range(1, 1), range(2, 1)
    tree:add(fields.da, da)
    tree:add(fields.sa, sa)
    for _, one in ipairs({da, sa}) do tree:add(fields.addr, one, one:bitfield(1, 7)):set_hidden() end
    pinfo.cols.src, pinfo.cols.dst = tostring(sa:bitfield(1, 7)), tostring(da:bitfield(1, 7))
    local is_request, fc_function = add_fc(view, tree, fc)
    local at, sap = 3, {}
    for _, one in ipairs({{da, "dsap"}, {sa, "ssap"}}) do
        if one[1]:bitfield(0, 1) == 1 then
            if at >= range:len() then
                return view:complains(tree, "no_telegram", "an address announces a SAP, but no octet is left for it")
            end
            sap[one[2]] = range(at, 1):uint()
            tree:add(fields[one[2]], range(at, 1))
            at = at + 1
        end
    end
    local own = sap.ssap
    if is_request then own = sap.dsap end
    local service = service_of(sd, is_request, fc_function, own, sap.dsap)
    table.insert(view.words, 1, service)
    tree:add(fields.service, service):set_generated()
    if is_request and kAnswered[fc_function] then
        note_request(pinfo, da:bitfield(1, 7), service)
    elseif not is_request then
        note_reply(view, pinfo, tree, sa:bitfield(1, 7), sd == 0x10)
    end
    local data = at < range:len() and range(at) or nil
    local show = octets(own and "data" or is_request and "outputs" or "inputs")
    if own then show = (is_request and kOfRequests or kOfReplies)[own] or show end
    if data or (own and is_request and kOfRequests[own]) then show(view, tree, data) end
end

local function sum(range)
    local total, all = 0, range:bytes()
    for i = 0, all:len() - 1 do total = total + all:get_index(i) end
    return total % 256
end

-- How long the telegram at the begin of `tvb` is, and where DA lies; or nothing and why it is none.
local function length_of(tvb, sd)
    if sd == 0xE5 then return 1 end
    if sd == 0xDC then return 3 end
    if sd == 0x10 then return 6, 1 end
    if sd == 0xA2 then return 14, 1 end
    if not kDelimiters[sd] then return nil, ("0x%02X begins no telegram: 10, 68, A2, DC or E5 do"):format(sd) end
    if tvb:len() < 4 then return nil, ("it ends after %d octets: LE, LEr and 0x68 are missing"):format(tvb:len()) end
    local le, ler, again = tvb(1, 1):uint(), tvb(2, 1):uint(), tvb(3, 1):uint()
    if le ~= ler or again ~= 0x68 then return nil, "LE and LEr must be equal and 0x68 must follow" end
    if le < 4 or le > 249 then return nil, ("LE is %d: 4 to 249 are legal"):format(le) end
    return le + 6, 4
end

local function telegram(view, pinfo, tree, tvb)
    local sd = tvb(0, 1):uint()
    tree:add(fields.sd, tvb(0, 1))
    local length, place = length_of(tvb, sd)
    if length and tvb:len() < length then
        place, length = ("it has %d octets and should have %d"):format(tvb:len(), length), nil
    end
    if not length then
        if tvb:len() > 1 then tree:add(fields.data, tvb(1)) end
        return view:complains(tree, "no_telegram", "no telegram: " .. place)
    end
    if tvb:len() > length then view:complains(tree:add(fields.data, tvb(length)), "no_telegram", "octets behind the telegram") end
    if sd == 0xE5 or sd == 0xDC then
        local service = sd == 0xE5 and "SC" or "token"
        tree:add(fields.service, service):set_generated()
        table.insert(view.words, 1, service)
        if sd == 0xE5 then return note_reply(view, pinfo, tree, nil, true) end
        tree:add(fields.da, tvb(1, 1))
        tree:add(fields.sa, tvb(2, 1))
        pinfo.cols.src, pinfo.cols.dst = tostring(tvb(2, 1):bitfield(1, 7)), tostring(tvb(1, 1):bitfield(1, 7))
        return
    end
    if sd == 0x68 then
        tree:add(fields.le, tvb(1, 1))
        tree:add(fields.ler, tvb(2, 1))
        tree:add(fields.sd2, tvb(3, 1))
    end
    local range = tvb(place, length - 2 - place)
    body(view, pinfo, tree, sd, range)
    local fcs, ed = tvb(length - 2, 1), tvb(length - 1, 1)
    local item, right = tree:add(fields.fcs, fcs), sum(range)
    if fcs:uint() == right then item:append_text(" (right)")
    else view:complains(item, "bad_fcs", ("FCS is 0x%02X and should be 0x%02X"):format(fcs:uint(), right)) end
    item = tree:add(fields.ed, ed)
    if ed:uint() ~= 0x16 then
        view:complains(item, "no_telegram", ("the last octet is 0x%02X, not the end delimiter 0x16"):format(ed:uint()))
    end
end

-- Other programs write files with link types that Wireshark does not know, too. Ours begin with a start delimiter. What
-- was heard in place of a telegram may begin with anything: there the interface has the name that dpctl gives it.
local function is_ours(tvb)
    local name = frame_name()
    return kDelimiters[tvb(0, 1):uint()] ~= nil or (name ~= nil and name.value == "bus")
end

local types = DissectorTable.get("wtap_encap")
local before = types:get_dissector(wtap.USER0)
local frame_type = Field.new("frame.encap_type")

function profibus.dissector(tvb, pinfo, tree)
    if tvb:len() == 0 then return 0 end
    if not is_ours(tvb) then
        local kind = frame_type()
        if not before or not kind or kind.value ~= wtap.USER0 then return 0 end
        local went_well, taken = pcall(before.call, before, tvb, pinfo, tree) -- it says itself what is malformed
        return went_well and taken or tvb:len()
    end
    pinfo.cols.protocol = "PROFIBUS"
    local item = tree:add(profibus, tvb())
    local view = setmetatable({words = {}}, View)
    telegram(view, pinfo, item, tvb)
    local first = table.remove(view.words, 1) or ""
    local words = #view.words > 0 and first .. ": " .. table.concat(view.words, "; ") or first
    pinfo.cols.info = words
    item:append_text(", " .. first)
    return tvb:len()
end

types:add(wtap.UNKNOWN, profibus)
types:add(wtap.USER0, profibus)
