// SPDX-License-Identifier: Apache-2.0
#include "fixtures.hpp"

#include <map>

namespace dpslave::test {
namespace {

using nlohmann::json;

const char* const kBus =
    R"({"port":"/dev/ttyS1","baud":187500,"baud_state":"DP_Control","configured_baud":null,
                             "port_open":true,"driver_works":true,"listens":false,"unanswered":[],"stations":2,"exchanging":1,
                             "last_telegram_age_ms":2.4,"trouble":null,"port_settings":null})";

const char* const kStations = R"([
  {"name":"unwinder","address":5,"profile":"590","device":"590 with PROFIBUS-DP option board","state":"Data_Exch","master":2,
   "watchdog_ms":100,"min_tsdr":11,"groups":129,"sync":false,"freeze":false,"clear":false,"held":false,"held_because":null,"ride":null,"silent_because":null,"stat_diag":false,"diag_pending":false,"parameters":2,
   "demand_data":true,"left_count":1,"left_because":"watchdog expired","left_code":"watchdog",
   "drive":{"line":"p3","port":"/dev/ttyS2","protocol":"ei-ascii","unit":"00","link":"answers","port_open":true,"ever_answered":true,"baud":9600,"format":"7E1","direction":"none","timeout_ms":200,"cycle_ms":123.4,"reads":4000,
            "writes":1,"silences":3,"refusals":0,"losses":1,"last_trouble":null,"not_zeroed":null,"stalled_ms":null,"stalled_in":null,"port_settings":null}},
  {"name":"rewinder","address":16,"profile":"590","device":"590 with PROFIBUS-DP option board","state":"Wait_Prm","master":null,
   "watchdog_ms":null,"min_tsdr":11,"groups":0,"sync":false,"freeze":false,"clear":false,"held":false,"held_because":null,"ride":null,"silent_because":null,"stat_diag":true,"diag_pending":true,"parameters":0,
   "demand_data":false,"left_count":0,"left_because":null,"left_code":null,
   "drive":{"line":"p3","port":"/dev/ttyS2","protocol":"ei-ascii","unit":"01","link":"silent","port_open":true,"ever_answered":false,"baud":9600,"format":"7E1","direction":"none","timeout_ms":200,"cycle_ms":null,"reads":0,
            "writes":0,"silences":12,"refusals":0,"losses":0,"last_trouble":"no answer","not_zeroed":null,"stalled_ms":null,"stalled_in":null,"port_settings":null}}])";

const char* const kWords = R"([
  {"tag":7,"name":"SPEED FEEDBACK","direction":"in","octet":8,"raw":5000,"value":"50.00","state":"good","answer":null,"age_ms":12.0},
  {"tag":56,"name":null,"direction":"out","octet":8,"raw":64286,"value":"-12.50","state":"read_only","answer":null,"age_ms":null}])";

const char* const kInfo = R"({"stations":[
  {"name":"unwinder","profile":"590","device":"590 with PROFIBUS-DP option board","order_code":"590 option digit 2",
   "firmware":"4.2 or later","manual":"HA389815","ident":1331,"address_active":5,"address_pending":7,"address_min":0,
   "address_max":125,"max_parameters":12,"max_input_octets":32,"max_output_octets":32,"max_diag_octets":6,"demand_data":true,
   "sync":true,"freeze":true,"bauds":[9600,187500,1500000],"max_tsdr":[60,60,150],"tags_at":null,"identifiers":[],"tag_table":"590.csv","tags_in_table":312,
   "option_software":null,"comms_status":null,"resolution":null,
   "mnemonic_rule":"590plus","mnemonic_source":"590+ formula","mnemonics_assumed":true,"notes":[]}]})";

const char* const kDiagnosis = R"({"stations":[
  {"name":"rewinder",
   "octets":[{"octet":1,"offset":0,"value":6,"meaning":"Station_Not_Ready, Cfg_Fault"},
             {"octet":2,"offset":1,"value":5,"meaning":"Prm_Req"},
             {"octet":3,"offset":2,"value":0,"meaning":"-"},
             {"octet":4,"offset":3,"value":255,"meaning":"no master"},
             {"octet":5,"offset":4,"value":5,"meaning":"Ident_Number high"},
             {"octet":6,"offset":5,"value":51,"meaning":"Ident_Number low"}],
   "hex":"06 05 00 FF 05 33","bits":["Station_Not_Ready","Cfg_Fault","Prm_Req"],
   "refusal":{"code":"cfg_identifier","telegram":"Chk_Cfg","what":"no legal identifier","octet":3,"expected":"0x50 or 0x60","got":"0x51",
              "advice":"compare the modules chosen in the master with the GSD"},
   "last_prm":"88 01 0A 0B 05 33 00","last_cfg":"73 50 51","held":false,"scale_register":null,"unscaled":[],"denied":[],"trouble":["tag 999 is in no table"],
   "refused":[{"tag":999,"write":false,"code":"invalid_tag","text":"tag 999 is in no table"}]}]})";

const char* const kMembers =
    R"({"port":"/dev/ttyS1","baud":187500,"baud_state":"DP_Control","load_percent":20.5,"members":[
  {"address":2,"ours":false,"master":true,"slave":false,"state":"unknown","ident":null,"asked_by":null,"asked":0,"answers":0,
   "retries":0,"unanswered":0,"last_heard_age_ms":3.0,"last_asked_age_ms":null,
   "cycle":{"min_ms":4.21,"mean_ms":5.04,"max_ms":9.73},"load_percent":12.25},
  {"address":5,"ours":true,"master":false,"slave":true,"state":"Data_Exch","ident":1331,"asked_by":2,"asked":12000,
   "answers":12000,"retries":1,"unanswered":0,"last_heard_age_ms":4.5,"last_asked_age_ms":5.0,
   "cycle":{"min_ms":9.8,"mean_ms":10.0,"max_ms":12.4},"load_percent":8.25},
  {"address":9,"ours":false,"master":false,"slave":false,"state":"unknown","ident":null,"asked_by":2,"asked":40,"answers":0,
   "retries":80,"unanswered":120,"last_heard_age_ms":null,"last_asked_age_ms":150.0,"cycle":null,"load_percent":0}]})";

const char* const kLeds = R"({"stations":[{"name":"unwinder","meaning":"data exchange with the master",
  "leds":[{"name":"red","sink":"gpio:23","lit":false,"pattern":"off","trouble":null},
          {"name":"green","sink":"led:dpslaved-green","lit":true,"pattern":"flashing 2 Hz",
           "trouble":null}]}]})";

const char* const kTec = R"({"stations":[{"name":"booster","view":"profibus","rows":[
  {"name":"TYPE","generic_name":"TYPE","input":true,"value":2,"shown":"PROFIBUS DP","range":"0 to 9"},
  {"name":"ADDRESS","generic_name":"INPUT 1","input":true,"value":3,"shown":"3","range":"0 to 125"},
  {"name":"EXT DIAGNOSTIC","generic_name":"INPUT 2","input":true,"value":27317,"shown":">6AB5","range":"0 to FFFF"},
  {"name":"RIDE THROUGH","generic_name":"INPUT 4","input":true,"value":10,"shown":"10 s","range":"-1 to 60 s"},
  {"name":"FAULT","generic_name":"FAULT","input":false,"value":0,"shown":"NONE","range":""},
  {"name":"NETWORK STATE","generic_name":"OUTPUT 1","input":false,"value":0,"shown":"DATA EXCHANGE","range":""}],
  "trip":"1: LINK OVERVOLTS","trip_tag":4,"tripped":true,"notes":["WARNING: Setting the RIDE THROUGH parameter to anything other than zero could compromise safety."]}]})";

const char* const kCounters = R"({"groups":[{"name":"bus","counters":[
  {"name":"telegrams","value":123456,"meaning":"valid telegrams heard","minute":3000,"last_age_ms":500.0,"since_age_ms":3600000.0},
  {"name":"checked","value":60000,"meaning":"with a checksum","minute":1500,"last_age_ms":500.0,"since_age_ms":3600000.0},
  {"name":"octets","value":900000,"meaning":"received","minute":20000,"last_age_ms":500.0,"since_age_ms":3600000.0},
  {"name":"flaw: checksum","value":3,"meaning":"FCS wrong","minute":0,"last_age_ms":3600000.0,"since_age_ms":null}]},
  {"name":"unwinder","counters":[{"name":"data_exchange","value":7,"meaning":"Data_Exchange requests answered","minute":7,"last_age_ms":500.0,"since_age_ms":20000.0},
    {"name":"drive_reads","value":4000,"meaning":"transactions with the drive","minute":60,"last_age_ms":500.0,"since_age_ms":20000.0},
    {"name":"drive_delay_ms","value":420,"meaning":"of the late answers","minute":0,"last_age_ms":null,"since_age_ms":null}]},
  {"name":"control socket","counters":[{"name":"calls","value":9,"meaning":"","minute":1,"last_age_ms":500.0,"since_age_ms":20000.0}]}],
  "turnaround":[
  {"unit":"us","count":2000,"sum":66000,"p50":12,"p99":79,"p999":210,"highest":20000,"classes":[
    {"from":12,"to":12,"count":1600},{"from":64,"to":79,"count":399},{"from":14336,"to":null,"count":1}]},
  {"unit":"T_bit","count":2000,"sum":14000,"p50":3,"p99":15,"p999":40,"highest":3750,"classes":[
    {"from":3,"to":3,"count":1600},{"from":14,"to":14,"count":399},{"from":3584,"to":4095,"count":1}]}],
  "refresh":[{"station":"unwinder","line":"p3","rounds":{"unit":"ms","count":90,"sum":4500,"p50":31,"p99":63,"p999":63,"highest":60,
    "classes":[{"from":30,"to":31,"count":50},{"from":56,"to":63,"count":40}]}},
  {"station":"rewinder","line":"p3","rounds":{"unit":"ms","count":0,"sum":0,"p50":null,"p99":null,"p999":null,"highest":null,"classes":[]}}]})";

std::map<std::string, json> all()
{
    const json bus = json::parse(kBus), stations = json::parse(kStations), words = json::parse(kWords);
    json watched_words = json::array();
    watched_words.push_back({{"name", "unwinder"}, {"words", words}});
    json io = json::parse(
        R"({"stations":[{"name":"unwinder","address":5,"state":"Data_Exch","may_write":true,"clear":false,"sync":false,"freeze":false,
        "demand":{"request":[0,0,4096,7],"reply":[0,5000,4096,7],"words":"reads tag 7: answered"}},
       {"name":"rewinder","address":16,"state":"Wait_Prm","may_write":false,"clear":false,"sync":false,"freeze":false,"words":[],"demand":null}]})");
    io["stations"][0]["words"] = words;
    const json tag =
        json::parse(R"({"station":"unwinder","tag":7,"name":"SPEED FEEDBACK","raw":5000,"value":"50.00"})");
    json written = tag;
    written["master"] = nullptr;
    return {
        {"GetVersion",
         json::parse(R"({"program":"dpslaved","version":"9.8.7","interface":"org.dpslaved.Control"})")},
        {"GetStatus",
         {{"bus", bus},
          {"stations", stations},
          {"uptime_ms", 3'720'000},
          {"pid", 812},
          {"log", {{"level", "info"}, {"ends_in_ms", nullptr}}}}},
        {"ListStations", {{"stations", stations}}},
        {"GetInfo", json::parse(kInfo)},
        {"GetIo", io},
        {"GetDiagnosis", json::parse(kDiagnosis)},
        {"GetCounters", json::parse(kCounters)},
        {"GetBus", json::parse(kMembers)},
        {"GetLeds", json::parse(kLeds)},
        {"GetTec", json::parse(kTec)},
        {"SetTec", json::parse(kTec)},
        {"ProbeDrive",
         json::parse(
             R"({"station":"rewinder","line":"p3","port":"/dev/ttyS2","tried":130,"to_try":174,"longest_s":42,"done":true,"answering":[
            {"protocol":"ei-ascii","baud":19200,"format":"7E1","unit":"03","identity":">2650","version":null,
             "device":"650V, frames C to F","rules":[{"rule":"590plus","answering":[],"denied":[55,56],"silent":[],"unasked":[],"nameless":0},
             {"rule":"ac","answering":[55,56],"denied":[],"silent":[],"unasked":[],"nameless":0}],"best_rules":["ac"]}]})")},
        {"Reload", json::parse(R"({"applied":true,"changes":["station rewinder removed"],
            "leaving":[{"station":"rewinder","reason":"removed"}],
            "pending":["station unwinder: address 7 takes effect at the next start"],"warnings":[],"faults":[]})")},
        // Set_Prm of master 2 to station 5, its SC, a telegram with a wrong FCS, and a reply that was late.
        {"Trace",
         json::parse(
             R"({"line":null,"lost":3,"caught_up":true,"hold_back_ns":0,"now_ns":2000000000,"unix_ns":1700000002000000000,
            "records":"EgAAAAQAAAAAAAAAAAAAAADKmjsAAAAAAAAAAAAAAABoDAxohYJtPT6AAAALBTMAshYBAAIABAAAAAEAAAAAAAAAKGScOwAAAACgUJw7AAAAAOUGAAAABAAAAAIAAAAAAAAAAPfLPAAAAAAAAAAAAAAAABAFAklRFgAAAwEEBQAAAwAAAAAAAACAjWQ9AAAAAAAAAAAAAAAA"})")},
        {"ListIncidents",
         json::parse(
             R"({"folder":"/var/lib/dpslaved/incidents","not_kept":2,"failures":0,"trouble":null,"incidents":[
            {"number":7,"kind":"left","station":"unwinder","reason":"watchdog","text":"unwinder: Wait_Prm: no request of the master","count":3,
             "first_unix_ns":1700000001000000000,"last_unix_ns":1700000009000000000,"also":1}]})")},
        // The telegrams of Trace, above.
        {"GetIncident",
         {{"size", 545},
          {"octets",
           "ZHBzbGF2ZWQgaW5jaWRlbnQgMQp7Im51bWJlciI6Nywid2hhdCI6eyJraW5kIjoibGVmdCIsInN0YXRpb24iOiJ1bndp"
           "bmRlciIsInJlYXNvbiI6IndhdGNoZG9nIiwidGV4dCI6InVud2luZGVyOiBXYWl0X1BybTogbm8gcmVxdWVzdCBvZiB0"
           "aGUgbWFzdGVyIn0sImF0X25zIjoxMDAwMDAwMDAwLCJ1bml4X25zIjoxNzAwMDAwMDAxMDAwMDAwMDAwLCJob2xkX2Jh"
           "Y2tfbnMiOjAsImFsc28iOltdLCJwcm9ncmFtIjoiOS44LjciLCJzdGF0aW9ucyI6W3sibmFtZSI6InVud2luZGVyIiwi"
           "YWRkcmVzcyI6NSwicHJvZmlsZSI6IjU5MCIsInN0YXRlIjoiRGF0YV9FeGNoIiwibWFzdGVyIjoyLCJzZXRfcHJtIjoi"
           "ODAgMDAgMDAgMEIgMDUgMzMgMDAiLCJjaGtfY2ZnIjoiNjAgNTAifV19ChIAAAAEAAAAAAAAAAAAAAAAypo7AAAAAAAA"
           "AAAAAAAAaAwMaIWCbT0+gAAACwUzALIWAQACAAQAAAABAAAAAAAAAChknDsAAAAAoFCcOwAAAADlBgAAAAQAAAACAAAA"
           "AAAAAAD3yzwAAAAAAAAAAAAAAAAQBQJJURYAAAMBBAUAAAMAAAAAAAAAgI1kPQAAAAAAAAAAAAAAAArWGpg="}}},
        {"Watch", {{"bus", bus}, {"stations", stations}, {"words", watched_words}}},
        {"GetEvents", json::parse(R"({"lost":0,"newest":3,"events":[
            {"number":1,"age_ms":9000.0,"station":null,"kind":"daemon","text":"dpslaved 9.8.7 started","count":1},
            {"number":2,"age_ms":5000.0,"station":"unwinder","kind":"state","text":"unwinder: Data_Exch with master 2","count":1},
            {"number":3,"age_ms":1500.0,"station":"rewinder","kind":"refused","text":"rewinder: Chk_Cfg of master 2 was refused","count":40}]})")},
        {"GetSamples",
         json::parse(
             R"({"station":"unwinder","tag":7,"name":"SPEED FEEDBACK","direction":"in","lost":0,"newest":9,
            "more":false,"oldest_unix_ms":1699999000000,"now_unix_ms":1700000100000,"samples":[
            {"number":2,"unix_ms":1700000000000,"state":"good","raw":0,"scaled":0.0,"value":"0.00"},
            {"number":4,"unix_ms":1700000050000,"state":"good","raw":1000,"scaled":10.0,"value":"10.00"},
            {"number":6,"unix_ms":1700000060000,"state":"stale","raw":1000,"scaled":10.0,"value":"10.00"},
            {"number":7,"unix_ms":1700000080000,"state":"none","raw":0,"scaled":0.0,"value":""},
            {"number":9,"unix_ms":1700000090000,"state":"unscaled","raw":0,"scaled":0.0,"value":"0.00"}]})")},
        {"FindTags", json::parse(R"({"station":"unwinder","tags":[{"tag":7,"name":"SPEED FEEDBACK"}]})")},
        {"SetLogLevel", json::parse(R"({"log":{"level":"debug","ends_in_ms":600000.0}})")},
        {"ReadTag", tag},
        {"GetSurveyScope",
         json::parse(R"({"station":"unwinder","protocol":"ei-ascii","tag_table":"/none/empty.csv",
            "tags":[{"first":1,"last":5},{"first":9,"last":9}]})")},
        {"Survey",
         json::parse(R"({"station":"unwinder","tag":1,"mnemonic":"a1","outcome":"value","text":"12.5",
            "raw":null,"reason":null})")},
        {"WriteTag", written},
    };
}

} // namespace

nlohmann::json fixture(const std::string& method)
{
    static const std::map<std::string, json> fixtures = all();
    return fixtures.at(method);
}

} // namespace dpslave::test
