"""Labels of English makers' sheets: each alone is the value it names; a row "- 130 mm = …" is nobody's value."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

# By type, rows of "name = label ; label @ heading above it | name = …".
WORDINGS = {
    "articulated_dump_truck": """
        Hoist Cylinder Stroke = Tipping ram stroke | Hoist Cylinder Bore = Body hoist cylinder bore dia. |
        Steering Cylinder Stroke = Steer cylinder stroke | Main Relief Pressure = Hoist relief pressure | Main
        Pump Flow = Pump flow rate at 2000 rpm | Rated Payload = Maximum rated payload | Empty Weight = Empty
        operating weight | Gross Weight = Operating weight, loaded | Body Capacity Heaped = Heaped 2:1 (SAE) |
        Body Capacity Struck = Body capacity, struck | Body Capacity Heaped with Tailgate = Heaped w/ tailgate
        | Body Capacity Struck with Tailgate = Body volume with tailgate, struck | Body Dump Angle = Max. dump
        angle | Body Raise Time = Body up time | Body Lower Time = Tipping time down | Maximum Travel Speed =
        Speeds, forward max. | Maximum Reverse Speed = Reverse speed max | Articulation Angle = Steering angle
        left and right | Turning Radius = Turning radius, SAE | Overall Length = Overall vehicle length |
        Overall Width = Overall width (over tyres) | Overall Height = Overall height unladen | Body Raised
        Height = Dump height, body fully raised | Loading Height = Loading height, body center | Dump
        Clearance = Body to ground clearance (raised) | Body Length Inside = Internal length of body | Body
        Width Inside = Body width inside | Body Width Outside = Body width, outside | Body Depth Inside = Max.
        body depth | Rear Overhang = Rear axle to rear of dump body | Front Axle to Bogie = Wheelbase, front -
        bogie | Bogie Axle Spacing = Rear bogie wheelbase | Front Tread = Track width, front | Rear Tread =
        Track width, rear | Ground Clearance = Ground clearance under front axle | Front Overhang = Front axle
        to front of machine | Approach Angle = Angle of approach | Net Power = Flywheel power net | Gross
        Power = Engine gross power | Engine Power = Max. engine power | - 140 mm = Floor thickness ;
        Suspension travel | - 2500 mm = Tailgate height ; Front frame width | - 15000 kg = Body weight ;
        Chassis weight | - 18 MPa = Brake pressure ; Fan pressure | - 80 kPa = Ground pressure unladen ;
        Ground pressure laden | - 150 L/min = Fan pump flow ; Emergency steering pump flow | - 30 km/h = 2nd
        forward ; Wind speed | - 40 ° = Oscillation angle ; Departure angle | - 20 s = Steering time ;
        Retarder response time | - 5 m³ = Fuel tank ; Fuel capacity | - 250 kW = Brake power ; Retarder power
    """,
    "backhoe_loader": """
        Loader Lift Cylinder Stroke = Loader lift cylinders - stroke | Loader Bucket Cylinder Stroke = Loader
        bucket ram stroke | Boom Cylinder Stroke = Boom ram stroke | Dipper Cylinder Stroke = Dipper ram
        stroke | Backhoe Bucket Cylinder Stroke = Backhoe bucket ram stroke | Swing Cylinder Stroke = Swing
        cylinders - stroke | Operating Weight = Operating weight with cab | Main Relief Pressure = Loader
        relief pressure | Main Pump Flow = Pump flow at 2,200 rpm | Maximum Travel Speed = Travel speed 4th |
        Overall Length = Overall length, road travel | Overall Height = Overall travel height | Overall Width
        = Overall width over tyres | Wheelbase = Wheelbase (four-wheel drive) | Ground Clearance = Ground
        clearance under chassis | Turning Radius = Outside tyre turning radius | Loader Hinge Pin Height =
        Bucket hinge pin height | Loader Dump Height = Dump clearance, max. | Loader Dump Reach = Reach at
        max. height | Loader Dump Angle = Dump angle at full height | Loader Rollback Angle = Roll back at
        ground | Loader Digging Depth = Loader bucket digging depth | Loader Breakout Force = Breakout force,
        loader | Loader Bucket Width = Bucket width (loader) | Loader Bucket Capacity = Bucket capacity (SAE
        heaped) | Loader Raise Time = Time to raise | Loader Lower Time = Lower, power down | Loader Dump Time
        = Loader bucket dump | Loader Lift Arm Breakout Force = Lift arm breakout | Loader Lift Capacity =
        Lift capacity, full height | Maximum Digging Depth = Max. dig depth | Maximum Reach at Ground Line =
        Ground level reach to slew centre | Backhoe Loading Height = Loading height (truck loading position) |
        Backhoe Operating Height = Max. working height | Backhoe Swing Arc = Swing arc of backhoe | Backhoe
        Bucket Rotation = Bucket rotation, max. | Bucket Digging Force = Digging force, bucket cylinder |
        Dipper Digging Force = Digging force, dipper cylinder | Swing Pivot to Rear Axle = Centerline of rear
        axle to swing pivot | Kingpost Clearance = Ground clearance at kingpost | Stabilizer Spread = Overall
        stabilizer width (operating) | Backhoe Bucket Capacity = Backhoe bucket (heaped) | Steering Angle =
        Max. steering angle | Front Axle Oscillation = Oscillation, front axle | - 120 mm = Stabilizer
        cylinder stroke ; Extendahoe cylinder stroke | - 2800 mm = Reach from rear axle centerline ; Front
        wheel tread | - 6500 mm = Turning circle diameter ; Clearance circle with bucket | - 1500 kg = Bucket
        weight ; Boom lift capacity | - 20 MPa = Brake pressure ; Auxiliary relief pressure | - 120 L/min =
        Steering pump flow ; Hammer flow | - 5 s = Backhoe swing time ; Curl time | - 40 km/h = 1st gear ; 2nd
        forward | - 40 ° = Approach angle ; Angle of departure | - 40 kN = Max. drawbar pull ; Loader tractive
        effort | - 0.9 m³ = Fuel tank ; Hydraulic tank
    """,
    "dozer": """
        Blade Lift Cylinder Stroke = Blade lift cylinders - stroke | Blade Tilt Cylinder Stroke = Dozer tilt
        ram stroke | Ripper Lift Cylinder Stroke = Ripper raise cylinder stroke | Main Relief Pressure = Dozer
        circuit relief | Main Pump Flow = Implement pump capacity | Operating Weight = Operating weight -
        standard | Maximum Travel Speed = Max. travel speed | Maximum Reverse Speed = Max. travel speed
        reverse | Shipping Weight = Tractor shipping weight | Blade Weight = Weight of dozer equipment | Blade
        Capacity = Dozer blade capacity | Blade Width = Width across blade | Blade Height = Height of blade |
        Blade Digging Depth = Blade lowering depth | Blade Lift Height = Max. lift of blade | Maximum Blade
        Tilt = Blade tilt adjustment | Blade Tilt Angle = Max. tilt angle | Blade Pitch Adjustment = Pitch
        adjustment of blade | Blade Angle = Angle of blade | Length Without Blade = Length of basic machine |
        Length with Blade = Length, with straight dozer | Width over Trunnions = Width (over trunnions) |
        Overall Height = Height to top of ROPS cab | Ground Clearance = Min. ground clearance | Track Gauge =
        Track width (center to center) | Shoe Width = Width of standard shoe | Width over Tracks = Width of
        tractor | Track Length on Ground = Track length on ground | Track Pitch = Pitch of track | Grouser
        Height = Height of grouser | Track Shoes Each Side = Number of links per side | Track Rollers Each
        Side = Number of track rollers (each side) | Carrier Rollers Each Side = Number of carrier rollers
        (each side) | Ground Pressure = Ground pressure, standard shoes | Drawbar Pull = Drawbar pull maximum
        | Ripper Penetration = Digging depth, ripper | Ripper Lift Height = Ripper raise height | - 130 mm =
        Link height ; Shank section | - 1500 mm = Shank spacing ; Exhaust height | - 3000 mm = Overall length
        with blade and ripper ; Ripper beam length | - 8000 kg = Winch weight ; Rear counterweight | - 20 MPa
        = Steering relief valve setting ; Fan pressure | - 60 kPa = Tire pressure ; Soil bearing capacity | -
        150 L/min = Fan pump flow ; Coolant flow | - 8 km/h = 2nd forward ; First gear | - 25 ° = Approach
        angle ; Track oscillation angle | - 200 kN = Pryout force ; Penetration force | - 0.6 m³ = Fuel
        capacity ; Engine crankcase | - 5 = Number of shanks ; Ripper pockets
    """,
    "excavator": """
        Boom Cylinder Stroke = Boom cylinder, stroke | Boom Cylinder Bore = Boom cylinder inside diameter |
        Boom Cylinder Rod Diameter = Boom cylinder rod dia. | Boom Cylinder Closed Length = Boom cylinder
        minimum length | Arm Cylinder Stroke = Stick cylinder - stroke | Arm Cylinder Bore = Stick cylinder -
        bore | Arm Cylinder Rod Diameter = Dipper ram rod dia | Bucket Cylinder Stroke = Bucket cylinder -
        stroke | Bucket Cylinder Bore = Bucket cylinder - bore | Adjust Cylinder Stroke = 2-piece boom adjust
        cylinder stroke | Adjust Cylinder Bore = Boom positioning cylinder bore | Blade Cylinder Stroke =
        Dozer ram - stroke | Blade Cylinder Bore = Blade cylinder - bore | Main Relief Pressure = Boom, arm
        and bucket circuits | Swing Relief Pressure = Slew motor relief pressure | Travel Relief Pressure =
        Maximum pressure - travel | Main Pump Flow = Max. flow, main pumps | Swing Speed = Superstructure slew
        speed | Swing Torque = Swing drive torque | Maximum Travel Speed = Travel speed high speed | Travel
        Speed Low = Tracking speed low | Drawbar Pull = Max. traction force | Operating Weight = Machine
        operating weight | Counterweight = Mass of counterweight | Bucket Weight = Bucket weight with teeth |
        Bucket Capacity = SAE heaped capacity | Bucket Width = Width over side cutters | Bucket Tip Radius =
        Bucket tooth radius | Boom Length = Monoblock boom length | Arm Length = Standard arm length | Maximum
        Digging Depth = Max excavation depth | Maximum Vertical Wall Digging Depth = Vertical dig depth |
        Maximum Digging Height = Max. cut height | Maximum Dumping Height = Load over height | Minimum Dumping
        Height = Min. dump height | Maximum Reach = Max dig radius | Maximum Reach at Ground Line = Maximum
        ground reach | Minimum Swing Radius = Work equipment minimum swing radius | Tail Swing Radius =
        Slewing radius rear end | Overall Length = Overall length (transport) | Overall Width = Overall width
        of tracks | Overall Height = Overall height of boom | Cab Height = Cab top height | Height to Handrail
        = Height with guard rail | Upperstructure Width = Upper structure overall width | Track Length =
        Overall crawler length | Track Length on Ground = Ground contact length | Track Gauge = Track center
        to center | Shoe Width = Width of track shoes | Track Height = Height of tracks | Ground Clearance =
        Ground clearance, undercarriage | Counterweight Clearance = Clearance height under counterweight |
        Bucket Digging Force = Bucket curling force | Arm Digging Force = Max. dipper tear out | Track Shoes
        Each Side = No. of shoes each side | Track Rollers Each Side = No. of lower rollers | Carrier Rollers
        Each Side = No. of upper rollers | Blade Width = Width of dozer | Blade Height = Overall blade height
        | Blade Lift Height = Max. raised height of blade | Blade Digging Depth = Max. blade depth below
        ground | Boom Swing Angle Left = Boom swing angle, LH | Boom Swing Angle Right = Boom swing angle, RH
        | Ground Pressure = Ground pressure (600 mm shoes) | Net Power = Engine power net | Gross Power =
        Engine power gross | Engine Power = Rated engine power | - 130 mm = Outrigger cylinder bore ; Grouser
        height | - 1200 mm = Boom foot height ; Cab width | - 2500 mm = Stabilizer width ; Undercarriage width
        retracted | - 3000 kg = Shipping weight ; Weight of arm incl. cylinder | - 20 MPa = Auxiliary circuit
        pressure ; Heavy lift pressure | - 60 kPa = Tire pressure ; Brake release pressure | - 200 L/min =
        Auxiliary hydraulic flow ; Breaker circuit flow | - 4 km/h = Wind speed ; Travel speed reverse | - 10
        rpm = Grapple rotation speed ; Tiltrotator speed | - 120 kN = Arm digging force with power boost ;
        Blade push force | - 100 kW = Alternator power ; Heater output | - 0.5 m³ = Hydraulic tank ; Bucket
        struck capacity | - 45 ° = Climbing ability ; Bucket rotation | - 7 = Number of speeds ; Number of
        swing motors
    """,
    "forklift": """
        Lift Cylinder Stroke = Hoist cylinder stroke | Free Lift Cylinder Stroke = Free-lift ram stroke | Tilt
        Cylinder Stroke = Tilting cylinder stroke | Main Relief Pressure = Max. system pressure | Main Pump
        Flow = Lift pump flow | Rated Capacity = Nominal load capacity | Load Center = Load centre distance |
        Load Distance = Axle centre to fork face | Operating Weight = Truck service weight | Axle Load Front
        Laden = Axle weight laden, front | Axle Load Front Unladen = Axle loading without load, front | Mast
        Tilt Forward = Mast tilt, forward | Mast Tilt Backward = Mast tilt, backward | Lowered Mast Height =
        Mast height, lowered | Free Lift Height = Free lift, std. | Lift Height = Lifting height, standard |
        Extended Mast Height = Mast height, raised | Overhead Guard Height = Height of overhead guard (cabin)
        | Seat Height = Seat height/stand height | Coupling Height = Height of towing coupling | Length to
        Fork Face = Length excl. forks | Overall Length = Overall length including forks | Overall Width =
        Overall width (standard tires) | Wheelbase = Wheel base, Y | Ground Clearance = Ground clearance at
        wheelbase center | Turning Radius = Min. outside turning radius | Front Tread = Track width, front |
        Rear Tread = Track width, rear | Ground Clearance Below Mast = Clearance under mast | Fork Length =
        Fork blade length | Fork Width = Forks - width | Fork Thickness = Thickness of forks | Fork Carriage
        Width = Width of fork carriage | Aisle Width = Stacking aisle width | Travel Speed Laden = Driving
        speed with load | Travel Speed Unladen = Driving speed without load | Lift Speed Laden = Lifting
        speed, laden | Lift Speed Unladen = Hoist speed, unloaded | Lowering Speed Laden = Lowering speed -
        full load | Lowering Speed Unladen = Lowering speed unloaded | Drawbar Pull = Max. drawbar pull, laden
        | Tyre Diameter = Outer diameter of tyre | - 200 mm = Fork spread ; Curb clearance | - 1200 mm = Floor
        to seat index ; Overall width, dual drive tires | - 3600 mm = Intersecting aisle ; Diagonal width | -
        3000 kg = Sideshift weight ; Residual load capacity at max lift | - 16 MPa = Attachment pressure ;
        Tire pressure | - 60 L/min = Steering pump flow ; Auxiliary flow | - 18 km/h = Travel speed, reverse ;
        Wind speed | - 0.4 m/s = Sideshift speed ; Tilt speed | - 8 ° = Steering angle ; Sideways tilt | - 15
        kN = Drawbar pull without load ; Tractive force without load | - 40 kW = Lift motor rating ; Pump
        motor power | - 60 s = Acceleration time ; Charging time
    """,
    "grader": """
        Blade Lift Cylinder Stroke = Blade lift cylinders - stroke | Articulation Cylinder Stroke = Frame
        articulation cylinder stroke | Side Shift Cylinder Stroke = Moldboard sideshift cylinder stroke |
        Operating Weight = Operating weight, standard | Main Relief Pressure = Implement system pressure |
        Main Pump Flow = Pump output at 2200 rpm | Maximum Travel Speed = Maximum forward speed | Maximum
        Reverse Speed = Maximum speed reverse | Steering Angle = Steering range, L/R | Articulation Angle =
        Articulation - left/right | Front Axle Oscillation = Oscillation angle, front axle | Turning Radius =
        Turning radius (outside front tire) | Wheel Lean Angle = Wheel lean - left/right | Moldboard Length =
        Moldboard - width | Moldboard Height = Height of blade | Moldboard Thickness = Moldboard - thickness |
        Moldboard Arc Radius = Radius of curvature | Circle Rotation = Rotation of circle | Circle Diameter =
        Circle diameter (outside) | Blade Lift Above Ground = Moldboard ground clearance, max. | Depth of Cut
        = Blade depth below ground | Blade Side Shift Left = Moldboard side shift - left | Blade Side Shift
        Right = Moldboard side shift - right | Shoulder Reach = Shoulder reach, outside tires | Bank Cut Angle
        = Max. bank angle | Blade Tip Angle Forward = Tip angle - forward | Blade Tip Angle Backward = Blade
        pitch backward | Blade Pull = Blade pull at maximum | Blade Down Pressure = Blade downward force |
        Height to Top of Cylinders = Height - top of cylinders | Front Axle Height = Front axle centre height
        | Tandem Axle Spacing = Length, between tandem axles | Front Axle to Articulation = Front axle to
        frame articulation | Rear Axle to Articulation = Tandem centre to articulation | Front Axle to
        Moldboard = Blade base length | Tire Centerline Width = Width, tire centerlines | Overall Height =
        Height, top of cab | Overall Width = Width - outside rear tires | Overall Length = Length, front tire
        to rear frame end | Ground Clearance = Min. ground clearance | Ripper Penetration = Max. ripping depth
        | Ripper Lift Height = Ripper lift above ground | Wheelbase = Front axle to tandem centre | - 120 mm =
        End bit thickness ; Ripper shank spacing | - 600 mm = Scarifier working width ; Drawbar sideshift left
        | - 1800 mm = Front dozer blade width ; Exhaust height | - 9000 kg = Weight on front wheels ; On front
        wheels | - 20 MPa = Brake pressure ; Fan pressure | - 180 L/min = Fan pump flow ; Steering pump flow |
        - 30 km/h = Forward 4 ; 2nd gear | - 20 ° = Drawbar angle ; Gradeability | - 80 kN = Ripper pryout
        force ; Ripper pry out | - 0.4 m³ = Fuel tank ; Hydraulic tank | - 150 kW = Fan power ; AWD power
    """,
    "mobile_crane": """
        Luffing Cylinder Stroke = Boom hoist cylinder stroke | Luffing Cylinder Bore = Derricking ram bore |
        Telescoping Cylinder Stroke = Telescope cylinder stroke | Telescoping Cylinder Bore = Telescope
        cylinder bore | Outrigger Jack Cylinder Stroke = Vertical jack cylinder stroke | Outrigger Jack
        Cylinder Bore = Vertical jack cylinder bore | Main Relief Pressure = Crane hydraulic system pressure |
        Main Pump Flow = Total pump flow | Maximum Lifting Capacity = Max. rated lifting load | Radius at
        Maximum Capacity = Radius at max. capacity | Maximum Working Radius = Working radius max. | Boom
        Length Retracted = Min. boom length | Boom Length Extended = Boom length (extended) | Boom Sections =
        No. of boom sections | Boom Telescoping Time = Boom telescoping speed (extend) | Boom Luffing Time =
        Boom hoisting time | Boom Angle Maximum = Boom elevation - max. | Boom Angle Minimum = Min. elevation
        angle | Jib Length = Bi-fold swingaway length | Jib Offset Angle = Maximum offset angle | Maximum Tip
        Height = Max. lift height | Slewing Speed = Max. swing speed | Main Winch Line Speed = Main hoist max.
        single line speed | Main Winch Line Pull = Max. rope pull | Hoist Rope Diameter = Diameter of rope |
        Outrigger Spread Lateral = Outriggers - fully extended | Outrigger Spread Longitudinal = Longitudinal
        outrigger distance | Counterweight = Maximum total counterweight | Tail Swing Radius = Tail swing of
        counterweight | Operating Weight = Weight in working order | Axle Load = Axle load (each) | Maximum
        Travel Speed = Max. driving speed | Overall Length = Total vehicle length | Overall Width = Overall
        vehicle width | Overall Height = Overall height (boom stowed) | Ground Clearance = Min. ground
        clearance | Turning Radius = Turning radius, all-wheel steering | Approach Angle = Angle of approach |
        Departure Angle = Angle of departure | - 120 mm = Drum diameter ; Outrigger extension cylinder bore |
        - 20 mm = Boom plate thickness ; Auxiliary rope diameter | - 6000 mm = Wheel base ; Hook block height
        | - 3000 kg = Auxiliary winch capacity ; Auxiliary hook capacity | - 20 MPa = Steering pressure ;
        Pilot pressure | - 100 L/min = Swing pump flow ; Steering pump flow | - 100 m/min = Aux. hoist line
        speed ; Auxiliary hoist single line speed | - 60 kN = Aux. hoist line pull ; Minimum breaking force |
        - 12 rpm = Winch speed ; Fan speed | - 60 s = Boom retracting time ; Swing time 360° | - 25 ° = Swing
        angle ; Slewing angle | - 30 km/h = Off-road speed ; 1st gear | - 300 kW = Engine brake power ;
        Retarder power
    """,
    "rigid_dump_truck": """
        Hoist Cylinder Stroke = Hoist cylinders - stroke | Hoist Cylinder Bore = Body cylinder bore | Steering
        Cylinder Stroke = Steer cylinder stroke | Main Relief Pressure = Hoist relief valve setting | Main
        Pump Flow = Hoist pump output | Rated Payload = Nominal payload capacity | Empty Weight = Vehicle
        weight, empty | Gross Weight = Max. gross vehicle weight | Body Capacity Heaped = Heaped capacity 2:1
        | Body Capacity Struck = Rock body struck capacity | Body Dump Angle = Dump angle, body | Body Raise
        Time = Body raise time - high idle | Body Lower Time = Float down, empty | Body Weight = Rock body
        weight | Chassis Weight = Weight of chassis | Maximum Travel Speed = Max. forward speed | Maximum
        Reverse Speed = Maximum speed in reverse | Steering Angle = Steering angle, left/right | Turning
        Radius = Turning radius, center of front tire | Overall Length = Overall length of truck | Overall
        Width = Width over tyres | Overall Height = Overall height (body down) | Wheelbase = Wheel base (front
        to rear axle) | Front Tread = Front tyre centres | Rear Tread = Rear dual tyre centre width | Ground
        Clearance = Min. ground clearance | Tyre Diameter = Tire overall diameter | Body Raised Height =
        Height to top of body raised | Loading Height = Loading height - empty | Dump Clearance = Ground
        clearance under dump body | Body Length Inside = Inner length of body | Body Width Inside = Body width
        inside | Body Width Outside = Outer body width | Body Depth Inside = Depth of body | Rear Overhang =
        Centerline of rear axle to tail | Operating Width = Width over mirrors | Canopy Width = Width of
        canopy | Front Canopy Height = Canopy - height | Body Length Overall = Body length overall | Rear Axle
        Clearance = Ground clearance at rear axle | Engine Guard Clearance = Ground clearance under engine
        guard | Net Power = Net power SAE J1349 | Gross Power = Engine gross power | - 140 mm = Body floor
        thickness ; Liner thickness | - 3000 mm = Distance to front bumper ; Front overhang | - 40000 kg =
        Liner weight ; Weight of options | - 18 MPa = Brake pressure ; Suspension pressure | - 300 L/min = Fan
        pump flow ; Brake pump flow | - 30 km/h = 2nd gear ; Wind speed | - 45 ° = Approach angle ; Departure
        angle | - 40 m³ = Cooling system ; Coal body capacity | - 500 kW = Braking power ; Retarding capacity
    """,
    "skid_steer": """
        Lift Cylinder Stroke = Lift cylinders - stroke | Tilt Cylinder Stroke = Tilt cylinder(s), stroke |
        Operating Weight = Operating weight (with bucket) | Main Relief Pressure = Pressure at quick couplers
        | Main Pump Flow = Max. pump flow | Maximum Travel Speed = Travel speed - max | Overall Height =
        Height to top of cab/ROPS | Overall Width = Overall width, tires | Ground Clearance = Ground clearance
        to belly | Hinge Pin Height at Maximum Lift = Hinge pin height at max lift | Dumping Clearance = Dump
        height, fully raised | Dumping Reach = Reach at full lift and dump | Dump Angle at Maximum Lift = Dump
        angle, fully raised | Rack Back at Ground = Rack back angle | Digging Depth = Digging depth below
        ground | Breakout Force = Breakout force, bucket | Bucket Width = Width with bucket | Bucket Capacity
        = Bucket heaped capacity | Raise Time = Lift arms up | Lower Time = Lift arm lower | Dump Time = Full
        dump time | Rated Operating Capacity = SAE rated operating load | Tipping Load = Tipping load, ISO |
        Length with Bucket = Length, bucket on ground | Length Without Attachment = Length less attachments |
        Turning Radius with Bucket = Turning radius from center - front with bucket | Turning Radius Rear =
        Turning radius from center - rear | Departure Angle = Angle of departure | Operating Height Fully
        Raised = Overall height, fully raised | Lift Arm Breakout Force = Arm breakout force | Auxiliary Flow
        = Auxiliary hydraulics flow | - 100 mm = Engine bore ; Chain pitch | - 900 mm = Seat height ; Reach at
        ground | - 2500 mm = Loading height ; Fork height at max lift | - 900 kg = Counterweight ; ROC with
        optional counterweight | - 20 MPa = Drive relief pressure ; Tire pressure | - 100 L/min = Auxiliary
        high flow ; Super flow | - 10 km/h = Reverse ; Creep speed | - 25 ° = Gradeability ; Rack back at full
        height | - 20 kN = Traction force ; Drawbar pull | - 4 s = Rollback ; Rollback time | - 0.5 m³ =
        Struck capacity ; Fuel tank
    """,
    "wheel_loader": """
        Lift Cylinder Stroke = Hoist cylinders, stroke | Lift Cylinder Bore = Lift cylinders - bore dia. |
        Lift Cylinder Rod Diameter = Boom cylinder rod | Tilt Cylinder Stroke = Tilt cylinder - stroke | Tilt
        Cylinder Bore = Tilting cylinder bore | Tilt Cylinder Rod Diameter = Tilt cylinder rod | Steering
        Cylinder Stroke = Steer cylinder - stroke | Steering Cylinder Bore = Steering ram bore dia. | Steering
        Cylinder Rod Diameter = Steering cylinder piston rod | Main Relief Pressure = Maximum working
        pressure, loader | Steering Relief Pressure = Steering circuit relief | Main Pump Flow = Implement
        pump flow | Steering Pump Flow = Steering pump max. flow | Raise Time = Raise time, loaded bucket |
        Dump Time = Dump time at maximum lift | Lower Time = Boom lower time | Total Cycle Time = Cycle time,
        total | Operating Weight = Operating weight with standard bucket | Bucket Weight = Bucket weight incl.
        teeth | Counterweight Weight = Weight of counterweight | Static Tipping Load Straight = Static tipping
        load - straight (ISO 14397-1) | Static Tipping Load Full Turn = Static tipping load at 40° full turn |
        Breakout Force = Breakout force, 100 mm behind cutting edge | Rimpull = Max. tractive effort | Maximum
        Travel Speed = Travel speed, 4th | Maximum Steering Angle = Max. steering angle left/right | Steering
        Angle = Steering angle, left / right | Rear Axle Oscillation = Total rear axle oscillation | Rear Axle
        Oscillation Each Way = Rear axle oscillation each side | Wheelbase = Center line of front axle to
        center line of rear axle | Tread = Track width (tyre centres) | Hinge Pin Height at Maximum Lift =
        Hinge pin height | Hinge Pin Height at Carry = Carry position hinge pin height | Rack Back at Ground =
        Tilt-back angle at ground | Rack Back at Carry = Tilt back angle at carry | Rack Back at Maximum Lift
        = Rack back fully raised | Dump Angle at Maximum Lift = Maximum dumping angle at full height | Dumping
        Clearance = Dump clearance at full height | Dumping Reach = Reach at full lift | Lift Arm Clearance at
        Maximum Lift = Boom clearance at max. lift | Digging Depth = Digging depth below ground | Overall
        Length = Overall length with teeth | Overall Length Without Bucket = Length less bucket | Overall
        Height = Height to cab roof | Overall Operating Height = Max. overall height | Overall Width = Outside
        width of tires | Bucket Width = Cutting edge width | Ground Clearance = Ground clearance, at drive
        shaft | Hitch Height = Height to drawbar | Height to Top of Stack = Top of stack | Axle Height =
        Center line of axle height | Rear Overhang = Rear axle centerline to rear of counterweight | Rear Axle
        to Hitch = Rear axle to articulation joint | Turning Radius = Outside turning radius | Bucket Capacity
        Heaped = Volume, heaped ISO/SAE | Bucket Capacity Struck = Bucket struck volume | Tyre Diameter = Tire
        outer diameter | Tyre Width = Width of tire | - 150 mm = Brake disc diameter ; Track depth | - 1200 mm
        = Height to steering wheel ; Fork length | - 3500 mm = Clearance circle ; Clearance radius with bucket
        | - 10000 kg = Lifting capacity ; Shipping weight | - 20 MPa = Brake pressure ; Servo pressure | - 150
        L/min = Pilot pump flow ; Brake pump flow | - 6 s = Tilt back ; Curl | - 35 km/h = Reverse 4 ; Wind
        speed | - 45 ° = Oscillation of front axle ; Approach angle | - 120 kN = Lift force ; Lifting force at
        max. lift | - 3 m³ = Fuel tank capacity ; Engine oil
    """,
}


@pytest.mark.parametrize("kind", WORDINGS)
def test_labels(kind: str) -> None:
    rows = []
    for line in " ".join(WORDINGS[kind].split()).split(" | "):
        name, labels = line.split(" = ")
        entries = (entry.partition(" @ ") for entry in labels.split(" ; "))
        rows += [(name.removeprefix("- "), label, section) for label, _, section in entries]
    assert misread(kind, rows, strict=True) == []
