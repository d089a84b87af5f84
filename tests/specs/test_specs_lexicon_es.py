"""Labels of Spanish makers' sheets: each alone is the value it names; a row "- 130 mm = …" is nobody's value."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

# By type, rows of "name = label ; label @ heading above it | name = …".
WORDINGS = {
    "articulated_dump_truck": """
        Hoist Cylinder Stroke = Cilindros de elevación de la caja, carrera | Hoist Cylinder Bore = Cilindro de
        volteo, diámetro | Steering Cylinder Stroke = Cilindro de dirección, carrera | Main Relief Pressure =
        Presión de trabajo | Main Pump Flow = Caudal de las bombas | Rated Payload = Carga útil máx. | Empty
        Weight = Peso total en vacío | Gross Weight = Peso total con carga | Body Capacity Heaped = Capacidad
        de la caja, colmada | Body Capacity Struck = Capacidad al ras SAE | Body Capacity Heaped with Tailgate
        = Colmada con compuerta | Body Capacity Struck with Tailgate = A ras con compuerta | Body Dump Angle =
        Ángulo de elevación de la caja | Body Raise Time = Tiempo de basculación con carga | Body Lower Time =
        Bajada de la caja | Maximum Travel Speed = Velocidad de desplazamiento máx. | Maximum Reverse Speed =
        Velocidad máxima marcha atrás | Articulation Angle = Ángulo de articulación a cada lado | Turning
        Radius = Radio de giro mínimo | Overall Length = Longitud de la máquina | Overall Width = Ancho total
        sobre neumáticos | Overall Height = Altura hasta el techo de la cabina | Body Raised Height = Altura
        total con caja levantada | Loading Height = Altura de carga (vacío) | Dump Clearance = Despeje de
        descarga | Body Length Inside = Longitud interior caja | Body Width Outside = Anchura exterior de la
        caja | Body Depth Inside = Profundidad máxima de la caja | Rear Overhang = Eje trasero a extremo
        trasero | Front Axle to Bogie = Eje delantero a eje central | Bogie Axle Spacing = Distancia entre
        ejes del tándem | Ground Clearance = Despeje sobre el suelo | Front Overhang = Del eje delantero al
        frente | Net Power = Potencia neta SAE J1349 | Gross Power = Potencia bruta SAE J1995 | - 140 mm =
        Espesor del piso ; Carrera de la suspensión | - 2500 mm = Altura del guardabarros ; Ancho de la cabina
        | - 15000 kg = Eje delantero vacío ; Eje trasero cargado | - 18 MPa = Presión de dirección ; Presión
        de frenos | - 150 L/min = Bomba de dirección ; Caudal bomba de dirección | - 30 km/h = 1ª ; 2ª | - 40
        ° = Pendiente máxima ; Ángulo de salida | - 250 kW = Potencia de frenado ; Potencia del retardador | -
        5 m³ = Depósito de combustible ; Tanque de combustible
    """,
    "backhoe_loader": """
        Loader Lift Cylinder Stroke = Cilindro de levante de la cargadora, carrera | Boom Cylinder Stroke =
        Cilindro de la pluma, carrera | Dipper Cylinder Stroke = Cilindro del brazo, carrera | Swing Cylinder
        Stroke = Cilindro de giro, carrera | Operating Weight = Peso de operación con cabina 4x4 | Main Relief
        Pressure = Presión de trabajo | Main Pump Flow = Caudal de bomba a 2200 rpm | Maximum Travel Speed =
        Velocidad en carretera | Overall Length = Longitud total de transporte | Overall Height = Altura de
        transporte | Overall Width = Ancho total sin cucharón | Wheelbase = Distancia entre los ejes |
        Ground Clearance = Despeje sobre el suelo | Turning Radius = Radio de giro sobre neumáticos | Loader
        Hinge Pin Height = Altura máxima al pasador de articulación | Loader Dump Height = Altura de vuelco |
        Loader Dump Reach = Alcance de descarga a altura máxima | Loader Dump Angle = Ángulo de vuelco |
        Loader Rollback Angle = Retroceso del cucharón | Loader Digging Depth = Profundidad de excavación del
        cargador | Loader Breakout Force = Fuerza de arranque del cargador | Loader Bucket Width = Anchura del
        cazo | Loader Bucket Capacity = Capacidad del cucharón cargador | Loader Dump Time = Tiempo de vuelco
        | Loader Lift Arm Breakout Force = Fuerza de arranque de los brazos | Loader Lift Capacity = Capacidad
        de levante | Maximum Digging Depth = Profundidad de excavación máx. SAE | Maximum Reach at Ground Line
        = Alcance a nivel del suelo desde el centro de giro | Backhoe Loading Height = Altura de carga SAE |
        Backhoe Operating Height = Altura de trabajo máxima | Backhoe Swing Arc = Ángulo de giro de la pluma |
        Backhoe Bucket Rotation = Rotación de la cuchara | Bucket Digging Force = Fuerza de excavación de la
        cuchara | Dipper Digging Force = Fuerza de penetración del balancín | Swing Pivot to Rear Axle = Eje
        trasero al centro de giro | Stabilizer Spread = Ancho de estabilizadores extendidos | Backhoe Bucket
        Capacity = Capacidad cuchara retro | Steering Angle = Ángulo de dirección de las ruedas | - 2800 mm
        = Vía delantera ; Voladizo delantero | - 1500 kg =
        Carga por eje ; Peso del cucharón | - 20 MPa = Presión de dirección ; Presión de frenos | - 120 L/min
        = Caudal auxiliar ; Bomba de dirección | - 5 s = Recogida ; Recoger | - 40 kN = Fuerza de tracción ;
        Tiro en la barra | - 40 km/h = Marcha atrás ; 1ª marcha | - 0.9 m³ = Tanque de combustible ; Depósito
        de combustible
    """,
    "dozer": """
        Blade Lift Cylinder Stroke = Cilindro de elevación de la hoja, carrera | Blade Tilt Cylinder Stroke =
        Cilindro de inclinación de la hoja, carrera | Ripper Lift Cylinder Stroke = Cilindro de levantamiento
        del desgarrador, carrera | Main Relief Pressure = Ajuste de la válvula de alivio | Main Pump Flow =
        Caudal de la bomba del implemento | Operating Weight = Peso operativo con hoja y desgarrador | Maximum
        Travel Speed = Velocidad de desplazamiento máx. | Maximum Reverse Speed = Velocidad máxima marcha
        atrás | Shipping Weight = Peso del tractor | Blade Weight = Peso de la hoja dozer | Blade Capacity =
        Capacidad de la hoja (SAE J1265) | Blade Width = Ancho total de la hoja | Blade Height = Altura de la
        hoja topadora | Blade Digging Depth = Profundidad de ataque | Blade Lift Height = Levante máximo sobre
        el suelo | Maximum Blade Tilt = Ajuste de inclinación máxima | Blade Tilt Angle = Ángulo de
        inclinación lateral | Blade Angle = Ángulo de la hoja (cada lado) | Length Without Blade = Longitud
        sin equipos | Length with Blade = Longitud con hoja recta | Width over Trunnions = Ancho con muñones |
        Overall Height = Altura de la máquina | Ground Clearance = Espacio libre sobre el suelo | Track Gauge
        = Ancho entre vías | Shoe Width = Anchura de teja | Width over Tracks = Ancho exterior de orugas |
        Track Length on Ground = Longitud de oruga sobre el suelo | Track Pitch = Paso de la cadena | Grouser
        Height = Altura de garra | Track Shoes Each Side = Número de zapatas (cada lado) | Track Rollers Each
        Side = Rodillos de cadena (cada lado) | Carrier Rollers Each Side = Número de rodillos portadores por
        lado | Ground Pressure = Presión al suelo | Drawbar Pull = Fuerza de tiro máxima | Ripper Penetration
        = Profundidad máxima de desgarre | Ripper Lift Height = Altura de elevación del desgarrador | - 130 mm
        = Espesor de la cuchilla ; Altura del eslabón | - 1500 mm = Altura de la barra de tiro ; Altura del
        escape | - 3000 mm = Longitud total con desgarrador ; Longitud con hoja y desgarrador | - 8000 kg =
        Peso del desgarrador ; Peso del cabrestante | - 20 MPa = Presión de dirección ; Presión del ventilador
        | - 150 L/min = Bomba de dirección ; Caudal del ventilador | - 25 ° = Pendiente máxima ; Ángulo de
        entrada | - 200 kN = Fuerza de penetración ; Tiro del cabrestante | - 0.6 m³ = Depósito de combustible
        ; Tanque hidráulico | - 5 = Número de vástagos ; Número de cilindros
    """,
    "excavator": """
        Boom Cylinder Stroke = Carrera cilindro pluma | Boom Cylinder Bore = Cilindro de pluma - diámetro
        interior | Boom Cylinder Rod Diameter = Cilindro de la pluma, diámetro del vástago | Arm Cylinder
        Stroke = Cilindro del brazo, carrera | Arm Cylinder Bore = Cilindro del brazo, diámetro | Bucket
        Cylinder Stroke = Cilindro de cuchara - carrera | Bucket Cylinder Bore = Cilindro de cuchara -
        diámetro | Main Relief Pressure = Circuito de implementos | Swing Relief Pressure = Presión máxima:
        giro | Travel Relief Pressure = Presión máxima - traslación | Main Pump Flow = Caudal máximo de las
        bombas principales | Swing Speed = Velocidad de giro máx. | Swing Torque = Torque de giro | Maximum
        Travel Speed = Velocidad de marcha rápida | Travel Speed Low = Velocidad de desplazamiento (baja) |
        Drawbar Pull = Tracción máxima en la barra de tiro | Operating Weight = Peso en orden de marcha |
        Counterweight = Masa del contrapeso | Bucket Weight = Peso de la cuchara | Bucket Capacity = Capacidad
        de la cuchara (SAE colmada) | Bucket Width = Ancho de la cuchara | Bucket Tip Radius = Radio de la
        punta del cucharón | Boom Length = Largo del aguilón | Arm Length = Longitud del brazo estándar |
        Maximum Digging Depth = Máx. profundidad de excavación | Maximum Digging Depth 2.44 m Level Bottom =
        Profundidad máxima de corte con fondo plano de 2.440 mm | Maximum Vertical Wall Digging Depth =
        Profundidad de excavación vertical | Maximum Digging Height = Máx. altura de excavación | Maximum
        Dumping Height = Altura de vertido | Minimum Dumping Height = Altura mín. de descarga | Maximum Reach
        = Alcance máximo de trabajo | Maximum Reach at Ground Line = Alcance a nivel del terreno | Minimum
        Swing Radius = Radio mín. de giro del equipo | Tail Swing Radius = Radio de giro trasero de la
        superestructura | Overall Length = Longitud total en transporte | Overall Width = Anchura total del
        tren de rodaje | Overall Height = Altura total de transporte | Cab Height = Altura total hasta la
        cabina | Height to Handrail = Altura total (barandilla) | Upperstructure Width = Ancho total de la
        superestructura | Track Length = Longitud total de oruga | Track Length on Ground = Distancia entre
        centros de ruedas | Track Gauge = Ancho entre centros de orugas | Shoe Width = Anchura de tejas |
        Track Height = Altura de cadenas | Ground Clearance = Despeje mínimo sobre el suelo | Counterweight
        Clearance = Espacio libre bajo el contrapeso | Bucket Digging Force = Fuerza de ataque del cucharón |
        Arm Digging Force = Fuerza de excavación del balancín | Track Shoes Each Side = Número de zapatas
        (cada lado) | Track Rollers Each Side = Rodillos de rodadura | Carrier Rollers Each Side = Número de
        rodillos portadores por lado | Blade Width = Ancho de la hoja dózer | Blade Height = Altura de hoja |
        Blade Lift Height = Elevación de la hoja sobre el suelo | Blade Digging Depth = Descenso de la hoja
        bajo el suelo | Boom Swing Angle Left = Desplazamiento lateral de la pluma izquierda | Boom Swing
        Angle Right = Desplazamiento de pluma a la derecha | Ground Pressure = Presión de contacto | Net Power
        = Potencia al volante | Gross Power = Potencia bruta SAE J1995 | Engine Power = Potencia de motor | -
        130 mm = Diámetro y carrera del motor ; Diámetro del bulón | - 1200 mm = Altura del motor ; Altura del
        asiento | - 2500 mm = Radio de carga ; Ancho de transporte retraído | - 3000 kg = Peso de transporte ;
        Capacidad de elevación | - 20 MPa = Presión piloto ; Presión del freno | - 200 L/min = Caudal auxiliar
        ; Bomba de engranajes | - 4 km/h = Velocidad del viento ; Velocidad de remolque | - 120 kN = Fuerza de
        elevación ; Fuerza de la hoja | - 100 kW = Potencia del ventilador ; Potencia del alternador | - 0.5
        m³ = Tanque de combustible ; Depósito hidráulico | - 45 ° = Capacidad de ascenso ; Rotación de la
        cuchara | - 7 = Número de cilindros ; Número de dientes
    """,
    "forklift": """
        Lift Cylinder Stroke = Cilindro de elevación, carrera | Tilt Cylinder Stroke = Cilindro de
        inclinación, carrera | Main Relief Pressure = Presión de trabajo | Main Pump Flow = Caudal de aceite
        hidráulico | Rated Capacity = Capacidad de carga/carga | Load Center = Distancia del centro de
        gravedad de la carga | Load Distance = Distancia a la carga, centro del eje motriz a horquilla |
        Axle Load Front Laden = Peso por eje, con carga delante | Axle
        Load Front Unladen = Carga sobre eje delantero sin carga | Mast Tilt Forward = Ángulo de inclinación
        adelante | Mast Tilt Backward = Inclinación del mástil, atrás | Lowered Mast Height = Altura de mástil
        bajado | Free Lift Height = Elevación libre normal | Lift Height = Altura máx. de horquillas |
        Extended Mast Height = Altura con mástil extendido | Overhead Guard Height = Altura hasta el tejadillo
        de protección | Seat Height = Altura de asiento | Coupling Height = Altura de acoplamiento | Length to
        Fork Face = Longitud incluyendo dorsal de horquilla | Overall Length = Longitud con horquillas |
        Overall Width = Anchura de la máquina | Ground Clearance = Altura libre en el centro entre ejes |
        Turning Radius = Radio de giro Wa | Front Tread = Ancho de vía, delante | Rear Tread = Ancho de vía,
        detrás | Ground Clearance Below Mast = Distancia al suelo bajo mástil | Fork Length = Longitud de la
        horquilla | Fork Width = Anchura de horquillas | Fork Thickness = Espesor de la horquilla | Fork
        Carriage Width = Anchura del carro portahorquillas | Aisle Width = Ancho de pasillo de trabajo con
        palet 1000 x 1200 de ancho | Travel Speed Laden = Velocidad de conducción con carga | Travel Speed
        Unladen = Velocidad de traslación, vacía | Lift Speed Laden = Velocidad de elevación (con carga) |
        Lift Speed Unladen = Velocidad de elevación, sin carga | Lowering Speed Laden = Velocidad de descenso,
        con carga | Lowering Speed Unladen = Velocidad descenso sin carga | Drawbar Pull = Fuerza máxima de
        tracción con carga | - 200 mm = Desplazamiento lateral ; Altura del escalón | - 1200 mm = Distancia
        entre horquillas ; Ancho de la batería | - 3600 mm = Ancho de pasillo para palets 800 x 1200
        longitudinales ; Ancho de pasillo intersección | - 3000 kg = Carga por eje con carga, detrás ; Carga
        por eje sin carga, detrás | - 16 MPa = Presión de trabajo para implementos ; Presión para accesorios |
        - 60 L/min = Caudal de aceite para implementos ; Caudal para accesorios | - 18 km/h = Velocidad marcha
        atrás ; Velocidad del viento | - 0.4 m/s = Velocidad de inclinación ; Velocidad de retracción | - 8 °
        = Pendiente superable ; Ángulo de dirección | - 15 kN = Fuerza de tracción sin carga ; Fuerza del
        freno | - 40 kW = Motor de tracción ; Motor de elevación
    """,
    "grader": """
        Blade Lift Cylinder Stroke = Cilindro de levantamiento de la hoja, carrera | Articulation Cylinder
        Stroke = Cilindro de articulación, carrera | Operating Weight = Peso operativo, equipado típico | Main
        Relief Pressure = Presión máxima del implemento | Main Pump Flow = Salida de la bomba del implemento |
        Maximum Travel Speed = Velocidad máxima: avance | Maximum Reverse Speed = Velocidad máxima: retroceso
        | Steering Angle = Gama de dirección izquierda/derecha | Articulation Angle = Ángulo de articulación
        izquierda/derecha | Front Axle Oscillation = Eje delantero, oscilación total | Turning Radius = Radio
        de giro exterior de los neumáticos delanteros | Wheel Lean Angle = Inclinación de las ruedas
        izquierda/derecha | Moldboard Length = Longitud de hoja | Moldboard Thickness = Espesor de la
        vertedera | Moldboard Arc Radius = Radio del arco de la hoja | Throat Clearance = Despeje de la
        garganta | Circle Rotation = Ángulo de rotación del círculo | Circle Diameter = Diámetro de círculo |
        Blade Lift Above Ground = Altura máxima de elevación de la hoja | Depth of Cut = Profundidad de corte
        de la hoja | Blade Side Shift Left = Desplazamiento lateral de la hoja a la izquierda | Blade Side
        Shift Right = Desplazamiento lateral de la hoja a la derecha | Shoulder Reach = Alcance máximo de
        hombro fuera de los neumáticos | Bank Cut Angle = Ángulo máximo de corte en talud | Blade Tip Angle
        Forward = Inclinación hacia delante | Blade Tip Angle Backward = Inclinación de la hoja, atrás | Blade
        Pull = Tracción de la hoja | Blade Down Pressure = Presión de la hoja hacia abajo | Height to Top of
        Cylinders = Altura a los cilindros | Front Axle Height = Altura del eje delantero | Tandem Axle
        Spacing = Distancia entre ruedas tándem | Front Axle to Moldboard = Distancia del eje delantero a la
        hoja | Tire Centerline Width = Ancho: líneas centrales de los neumáticos | Overall Height = Altura con
        ROPS | Overall Width = Ancho sobre los neumáticos | Overall Length = Longitud de la máquina | Ground
        Clearance = Despeje sobre el suelo | Ripper Penetration = Profundidad máxima de desgarramiento |
        Ripper Lift Height = Altura de elevación del ripper | Wheelbase = Distancia eje delantero a centro del
        tándem | - 120 mm = Espesor de la cuchilla ; Ancho de la cuchilla | - 600 mm = Desplazamiento del
        círculo izquierdo ; Profundidad del escarificador | - 1800 mm = Ancho del desgarrador ; Ancho de
        trabajo del escarificador | - 9000 kg = Peso sobre el eje delantero ; Peso eje trasero | - 20 MPa =
        Presión de dirección ; Presión de frenos | - 80 kN = Fuerza de arranque del ripper | - 20 ° =
        Pendiente ; Oscilación del tándem
    """,
    "mobile_crane": """
        Luffing Cylinder Stroke = Cilindro de elevación de la pluma, carrera | Telescoping Cylinder Stroke =
        Cilindro telescópico, carrera | Maximum Lifting Capacity = Capacidad máxima de izaje | Radius at
        Maximum Capacity = Radio de trabajo a capacidad máxima | Maximum Working Radius = Radio máximo de
        trabajo | Boom Length Retracted = Longitud mínima de la pluma | Boom Length Extended = Longitud máx.
        de pluma | Boom Sections = Secciones de pluma | Boom Telescoping Time = Tiempo de extensión | Boom
        Luffing Time = Velocidad de elevación de la pluma | Boom Angle Maximum = Ángulo de elevación máximo |
        Boom Angle Minimum = Ángulo de pluma mínimo | Jib Length = Longitud del plumín plegable | Jib Offset
        Angle = Ángulo de desplazamiento del plumín | Maximum Tip Height = Altura de elevación máxima |
        Slewing Speed = Velocidad de giro máxima | Main Winch Line Speed = Velocidad de cable simple | Main
        Winch Line Pull = Cabrestante principal, tiro | Hoist Rope Diameter = Diámetro de cable | Outrigger
        Spread Lateral = Ancho con estabilizadores extendidos | Outrigger Spread Longitudinal = Distancia
        longitudinal entre estabilizadores | Counterweight = Masa del contrapeso | Tail Swing Radius = Radio
        de giro posterior | Operating Weight = Peso bruto del vehículo | Axle Load = Carga por eje máx. |
        Maximum Travel Speed = Velocidad de traslación | Overall Length = Longitud total del vehículo |
        Overall Width = Ancho del vehículo | Overall Height = Altura de transporte | Turning Radius = Radio de
        giro mínimo | Main Relief Pressure = Presión de trabajo | - 20 mm = Diámetro del cable auxiliar ;
        Diámetro del cable del cabrestante auxiliar | - 6000 mm = Distancia entre ejes ; Longitud del cable |
        - 3000 kg = Peso del gancho ; Capacidad del plumín | - 20 MPa = Presión de dirección ; Presión de
        frenos | - 100 m/min = Velocidad del cable auxiliar ; Cabrestante auxiliar, velocidad del cable | - 60
        kN = Tiro del cable auxiliar ; Carga de rotura del cable | - 60 s = Tiempo de descenso de la pluma ;
        Retracción de la pluma | - 25 ° = Pendiente superable ; Inclinación de la cabina | - 30 km/h =
        Velocidad marcha atrás ; 1ª marcha
    """,
    "rigid_dump_truck": """
        Hoist Cylinder Stroke = Cilindro de levante, carrera | Main Relief Pressure = Presión del sistema de
        levante | Main Pump Flow = Flujo de la bomba de levante | Rated Payload = Carga útil objetivo | Empty
        Weight = Peso en vacío | Gross Weight = Peso bruto máximo | Body Capacity Heaped = Colmada (SAE 2:1) |
        Body Dump Angle = Ángulo de vaciado | Body Raise Time =
        Levantamiento de la caja | Body Lower Time = Bajada de la caja | Body Weight = Peso de la tolva
        estándar | Chassis Weight = Peso del chasis con sistema de levante | Maximum Travel Speed = Velocidad
        máxima con carga | Steering Angle = Ángulo de dirección máximo | Turning Radius = Radio de giro
        delantero | Overall Width = Ancho sobre neumáticos traseros | Overall Height = Altura a la ROPS |
        Wheelbase = Distancia entre los ejes | Front Tread = Ancho de vía delantera | Rear Tread = Ancho de
        vía trasera | Body Raised Height = Altura con la tolva levantada | Loading Height = Altura de carga,
        vacía | Dump Clearance = Despeje de descarga | Body Length Inside = Largo interior de la tolva | Body
        Width Inside = Ancho interior de la tolva | Body Width Outside = Ancho de la tolva | Body Depth Inside
        = Profundidad máxima de la tolva | Rear Overhang = Distancia del eje trasero a la cola | Operating
        Width = Ancho total en operación | Canopy Width = Ancho total del techo de la caja | Front Canopy
        Height = Altura de la visera delantera | Body Length Overall = Largo total de la tolva | Rear Axle
        Clearance = Despeje del eje trasero | Engine Guard Clearance = Despeje del protector del motor |
        Ground Clearance = Despeje sobre el suelo | - 3000 mm = Ancho del parachoques ; Altura de la escalera
        | - 40000 kg = Eje delantero vacío ; Eje trasero cargado | - 18 MPa = Presión de la dirección ;
        Presión del freno | - 40 m³ = Tanque de combustible ; Capacidad 3:1 | - 500 kW = Potencia de retardo ;
        Potencia de frenado | - 45 ° = Pendiente máxima ; Pendiente del piso
    """,
    "skid_steer": """
        Lift Cylinder Stroke = Cilindro de elevación, carrera | Tilt Cylinder Stroke = Cilindro de
        inclinación, carrera | Operating Weight = Peso de trabajo | Main Relief Pressure = Presión de trabajo
        | Main Pump Flow = Capacidad de la bomba | Maximum Travel Speed = Velocidad de traslación máx. |
        Overall Height = Altura con cabina | Overall Width = Ancho con neumáticos | Ground Clearance = Despeje
        sobre el suelo | Hinge Pin Height at Maximum Lift = Altura del bulón del cazo | Dumping Clearance =
        Despeje a levantamiento y descarga máximos | Dumping Reach = Alcance a levantamiento y descarga
        máximos | Dump Angle at Maximum Lift = Ángulo de vuelco | Rack Back at Ground = Inclinación hacia
        atrás a nivel del suelo | Digging Depth = Profundidad de corte | Breakout Force = Fuerza de
        rompimiento del cucharón | Bucket Width = Anchura del cazo | Bucket Capacity = Capacidad del balde |
        Raise Time = Subida de brazos | Lower Time = Bajada de brazos | Dump Time = Tiempo de vuelco | Rated
        Operating Capacity = Capacidad de carga nominal | Tipping Load = Carga de basculamiento | Length with
        Bucket = Largo con balde | Length Without Attachment = Longitud sin cuchara | Turning Radius with
        Bucket = Radio de giro delantero con cuchara | Operating Height Fully Raised = Altura total, brazos
        levantados | Lift Arm Breakout Force = Fuerza de rotura brazos | Auxiliary Flow = Flujo auxiliar
        estándar | - 900 mm = Altura del asiento ; Voladizo trasero | - 2500 mm = Altura del faro giratorio ;
        Altura con horquillas | - 900 kg = Peso de transporte ; Contrapeso | - 20 MPa = Presión de carga ;
        Presión de los neumáticos | - 100 L/min = Gran caudal ; Bomba de carga | - 4 s = Recogida ; Retroceso
        del cucharón | - 10 km/h = Marcha atrás ; Gama baja | - 25 ° = Ángulo de entrada ; Recogida a altura
        máxima | - 20 kN = Fuerza de tracción ; Tracción | - 0.5 m³ = Depósito de combustible ; Tanque de
        combustible
    """,
    "wheel_loader": """
        Lift Cylinder Stroke = Cilindro de levante - carrera | Lift Cylinder Bore = Cilindro de elevación,
        diámetro | Tilt Cylinder Stroke = Cilindro de inclinación - carrera | Tilt Cylinder Bore = Cilindro de
        volteo, diámetro | Steering Cylinder Stroke = Cilindro de dirección, carrera | Main Relief Pressure =
        Válvula de alivio | Steering Relief Pressure = Presión del sistema de dirección | Main Pump Flow =
        Salida máxima de la bomba | Steering Pump Flow = Flujo de la bomba de la dirección | Raise Time =
        Tiempo de levantamiento | Dump Time = Tiempo de vertido | Lower Time = Descenso en vacío | Total Cycle
        Time = Tiempo de ciclo hidráulico total | Operating Weight = Peso en orden de marcha | Bucket Weight =
        Peso del cazo | Static Tipping Load Straight = Carga límite de equilibrio estático, recto | Static
        Tipping Load Full Turn = Carga de vuelco estática, giro total de 40° | Breakout Force = Fuerza de
        ruptura | Rimpull = Fuerza de tracción máx. | Maximum Travel Speed = Velocidad de traslación máxima |
        Maximum Steering Angle = Ángulo de articulación máx. | Steering Angle = Ángulo de viraje | Rear Axle
        Oscillation = Oscilación eje trasero | Rear Axle Oscillation Each Way = Oscilación del eje trasero a
        cada lado | Wheelbase = Distancia entre ejes de ruedas | Tread = Vía de ruedas | Hinge Pin Height at
        Maximum Lift = Altura máxima del bulón | Hinge Pin Height at Carry = Altura del pasador en transporte
        | Rack Back at Ground = Retroceso en el suelo | Rack Back at Carry = Ángulo de recogida en transporte
        | Rack Back at Maximum Lift = Retroceso a elevación máxima | Dump Angle at Maximum Lift = Ángulo de
        vuelco | Dumping Clearance = Altura de vuelco | Dumping Reach = Alcance a levantamiento máximo y
        descarga de 45° | Lift Arm Clearance at Maximum Lift = Altura libre bajo el brazo a levante máximo |
        Digging Depth = Profundidad máxima de excavación | Overall Length = Longitud total (cucharón en el
        suelo) | Overall Length Without Bucket = Longitud total sin cuchara | Overall Height = Altura hasta la
        parte superior de la cabina | Overall Operating Height = Altura máxima con cuchara elevada | Overall
        Width = Anchura total con neumáticos | Bucket Width = Anchura del cazo | Ground Clearance = Luz libre
        al suelo | Hitch Height = Altura al enganche | Height to Top of Stack = Altura hasta la parte superior
        del escape | Axle Height = Altura hasta la línea central del eje | Rear Overhang = Distancia eje
        trasero a contrapeso | Rear Axle to Hitch = Del eje trasero al enganche | Turning Radius = Radio de
        giro sobre neumáticos | Bucket Capacity Heaped = Capacidad del cucharón colmado | Bucket Capacity
        Struck = Capacidad al ras | Tyre Diameter = Diámetro de la rueda | - 150 mm = Espesor de la cuchilla ;
        Ancho del diente | - 1200 mm = Altura del capó ; Altura del asiento | - 3500 mm = Radio de giro sobre
        cucharón ; Radio de giro interior | - 10000 kg = Capacidad de carga ; Capacidad de elevación | - 20
        MPa = Presión de pilotaje ; Presión de frenos | - 150 L/min = Caudal del ventilador ; Caudal de la
        bomba piloto | - 6 s = Retroceso ; Recogida | - 35 km/h = Marcha atrás ; Retroceso 4 | - 45 ° = Ángulo
        de salida ; Ángulo de entrada | - 120 kN = Fuerza de elevación ; Fuerza de levantamiento | - 3 m³ =
        Depósito de combustible ; Tanque de combustible
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
